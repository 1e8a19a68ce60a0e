// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/trc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "motex/core/error.h"
#include "motex/core/files.h"

namespace motex {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

const std::string kHead =
    "PathFileType\t4\t(X/Y/Z)\twalk.trc\n"
    "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n"
    "120\t120\t2\t2\tmm\t120\t1\t2\n"
    "Frame#\tTime\tLHEE\t\t\tRHEE\t\t\n"
    "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size()) text.replace(at, from.size(), to);
  return text;
}

std::int64_t line_of_error(const std::string& text) {
  try {
    read_trc_bytes(text, "x.trc");
  } catch (const ParseError& error) {
    return error.position();
  }
  return -1;
}

TEST(ReadTrc, SaysTheLineOfWhatIsWrong) {
  EXPECT_EQ(line_of_error("hello\n"), 1);
  EXPECT_EQ(line_of_error("PathFileType\t4\n"), 1);
  EXPECT_EQ(line_of_error(kHead), 6);                                  // no frame
  EXPECT_EQ(line_of_error(kHead + "1\t0\t1\t2\t3\t4\t5\tsix\n"), 7);   // no number
  EXPECT_EQ(line_of_error(kHead + "1\t0\t1\t2\t3\t4\t5\n"), 7);        // two of three
  EXPECT_EQ(line_of_error(kHead + "1\t0\t1\t2\t3\t4\t5\t6\t7\n"), 7);  // one too many
  EXPECT_EQ(line_of_error(kHead + "1\t0\t1\t2\t3\t4\t5\t6\n2\t0\tinf\t2\t3\n"), 8);
  EXPECT_EQ(line_of_error(replaced(kHead, "\nFrame#\tTime\tLHEE\t\t\tRHEE\t\t", "\nFrame#\tTime") + "1\t0\n"), 4);
}

TEST(ReadTrc, ReadsPlacesGapsRateAndUnit) {
  const MarkerSet markers =
      read_trc_bytes(kHead + "1\t0\t1\t2\t3\t4\t5\t6\n2\t0.00833\t\t\t\t-4.5\t5e1\t6\n", "walk.trc");
  EXPECT_EQ(markers.names, (std::vector<std::string>{"LHEE", "RHEE"}));
  ASSERT_EQ(markers.num_frames(), 2);
  EXPECT_EQ(markers.position(0, 0), Vector3(1, 2, 3));
  EXPECT_EQ(markers.position(0, 1), Vector3(4, 5, 6));
  EXPECT_FALSE(markers.seen(1, 0));
  EXPECT_EQ(markers.position(1, 1), Vector3(-4.5, 50, 6));
  EXPECT_DOUBLE_EQ(markers.frame_rate(), 120);
  EXPECT_DOUBLE_EQ(markers.metres_per_unit, 0.001);
}

TEST(ReadTrc, ReadsOtherLineEndsSeparatorsAndGaps) {
  const std::string rows = "1\t0\t1\t2\t3\t4\t5\t6\n2\t0.1\tNaN\tnan\tNaN\t7\t8\t9\n3\t0.2\t1\t1\t1\n";
  const MarkerSet plain = read_trc_bytes(kHead + rows, "x.trc");
  EXPECT_FALSE(plain.seen(1, 0));
  EXPECT_FALSE(plain.seen(2, 1));
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"\n", "\r\n"}, {"\n", "\r"}, {"\t", ";"}, {"\t", ","}}) {
    const MarkerSet other = read_trc_bytes(replaced(kHead + rows, from, to), "x.trc");
    ASSERT_EQ(other.names, plain.names);
    ASSERT_EQ(other.num_frames(), 3);
    EXPECT_EQ(other.position(1, 1), Vector3(7, 8, 9));
    EXPECT_FALSE(other.seen(2, 1));
  }
}

TEST(ReadTrc, RateComesFromTheTimesWhereTheHeaderHasNone) {
  const std::string head = replaced(kHead, "120\t120\t2", "0\t0\t2"), row = "\t1\t2\t3\t4\t5\t6\n";
  EXPECT_NEAR(read_trc_bytes(head + "1\t0" + row + "2\t0.02" + row, "x.trc").frame_rate(), 50, 1e-9);
  EXPECT_THROW(read_trc_bytes(head + "1\t0" + row, "x.trc"), ParseError);
  ReadClipOptions options;
  options.fps = 30;
  EXPECT_DOUBLE_EQ(read_trc_bytes(head + "1\t0" + row, "x.trc", options).frame_rate(), 30);
}

TEST(ReadTrc, MemoryIsBoundedByTheFile) {
  std::string names, rows;
  for (int m = 0; m < 20'000; ++m) names += "\tm\t\t";
  for (int t = 0; t < 20'000; ++t) rows += "1\n";
  EXPECT_THROW(read_trc_bytes(replaced(kHead, "\tLHEE\t\t\tRHEE\t\t", names) + rows, "x.trc"), ParseError);
}

TEST(ReadTrc, ReadsACommaTableOfAProgramOfTheWorld) {
  std::vector<std::string> warnings;
  JobContext job;
  job.on_warning = [&](const std::string& text) { warnings.push_back(text); };
  const std::string path = std::string(MOTEX_TEST_DATA) + "/mocap/markers/opensim_commas_8_frames.trc";
  const MarkerSet markers = read_trc_bytes(read_file(path), path, {}, job);
  EXPECT_EQ(markers.num_markers(), 51);
  EXPECT_EQ(markers.num_frames(), 8);
  EXPECT_EQ(markers.names[1], "ASISr");
  EXPECT_EQ(markers.position(1, 0), Vector3(733.4084, 81.0119, 191.8306));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("652"), std::string::npos);
}

TEST(WriteTrc, IsReadAgainToTheLastBit) {
  MarkerSet markers;
  markers.name = "made";
  markers.names = {"A", "B\tC"};
  markers.metres_per_unit = 0.01;
  markers.frame_time_secs = 1.0 / 60;
  markers.positions = FrameMatrix::Random(30, 6) * 123.456;
  markers.set_position(0, 0, Vector3::Constant(kNaN));
  markers.set_position(29, 1, Vector3::Constant(kNaN));
  const MarkerSet again = read_trc_bytes(write_trc_bytes(markers), "again.trc");
  EXPECT_EQ(again.names, (std::vector<std::string>{"A", "B_C"}));
  EXPECT_EQ(again.metres_per_unit, 0.01);
  EXPECT_NEAR(again.frame_rate(), 60, 1e-9);
  ASSERT_EQ(again.num_frames(), 30);
  for (Index t = 0; t < 30; ++t)
    for (int m = 0; m < 2; ++m) {
      ASSERT_EQ(again.seen(t, m), markers.seen(t, m));
      if (markers.seen(t, m)) {
        EXPECT_EQ(again.position(t, m), markers.position(t, m));
      }
    }
}

TEST(WriteTrc, OtherUnitsBecomeMillimetres) {
  MarkerSet markers;
  markers.names = {"A"};
  markers.metres_per_unit = 0.0254;
  markers.positions = FrameMatrix::Constant(2, 3, 10);
  const MarkerSet again = read_trc_bytes(write_trc_bytes(markers), "again.trc");
  EXPECT_EQ(again.metres_per_unit, 0.001);
  EXPECT_NEAR(again.position(0, 0).x(), 254, 1e-9);
}

}  // namespace
}  // namespace motex
