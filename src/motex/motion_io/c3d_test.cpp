// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/c3d.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/motion_io/markers_io.h"

namespace motex {
namespace {

constexpr double kScaleOfIntegers = 0.28119;  // of pc_int and dec_int, mm
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string fixture(const std::string& name) {
  return read_file(std::string(MOTEX_TEST_DATA) + "/mocap/markers/" + name + ".c3d");
}

/// As make_c3d.py places them, with z up.
Vector3 made_place(int m, Index frame) {
  const auto t = static_cast<double>(frame);
  return {10.0 * m + t, -5.0 * m + 0.5 * t, 1000 - 100.0 * m + 0.25 * t};
}

JobContext collecting(std::vector<std::string>& warnings) {
  JobContext job;
  job.on_warning = [&warnings](const std::string& text) { warnings.push_back(text); };
  return job;
}

MarkerSet some_markers(Index num_frames, int num_markers) {
  MarkerSet markers;
  markers.name = "some";
  markers.metres_per_unit = 0.001;
  markers.frame_time_secs = 1.0 / 128;
  markers.positions.resize(num_frames, 3 * num_markers);
  for (int m = 0; m < num_markers; ++m) {
    markers.names.push_back("M" + std::to_string(m));
    for (Index t = 0; t < num_frames; ++t)
      markers.set_position(t, m, (t + m) % 5 == 2 ? Vector3::Constant(kNaN) : made_place(m, t % 64));
  }
  return markers;
}

void expect_same_places(const MarkerSet& a, const MarkerSet& b, double tolerance) {
  ASSERT_EQ(a.num_frames(), b.num_frames());
  ASSERT_EQ(a.names, b.names);
  for (Index t = 0; t < a.num_frames(); ++t)
    for (int m = 0; m < a.num_markers(); ++m) {
      ASSERT_EQ(a.seen(t, m), b.seen(t, m)) << "frame " << t << ", marker " << m;
      if (a.seen(t, m)) {
        ASSERT_LE((a.position(t, m) - b.position(t, m)).norm(), tolerance) << "frame " << t << ", marker " << m;
      }
    }
}

TEST(ReadC3d, RefusesWhatIsNoC3d) {
  EXPECT_THROW(read_c3d_bytes("", "x.c3d"), ParseError);
  EXPECT_THROW(read_c3d_bytes(std::string(100, '\2'), "x.c3d"), ParseError);
  EXPECT_THROW(read_c3d_bytes(std::string(4096, 'a'), "x.c3d"), ParseError);
  EXPECT_THROW(read_c3d_bytes(std::string(4096, '\0'), "x.c3d"), ParseError);
}

TEST(ReadC3d, SaysWhereAFileIsCutOff) {
  const std::string whole = fixture("pc_real");
  for (const std::size_t size : {std::size_t{511}, std::size_t{600}, std::size_t{8000}, whole.size() - 1024}) {
    try {
      read_c3d_bytes(whole.substr(0, size), "cut.c3d");
      FAIL() << size;
    } catch (const ParseError& error) {
      EXPECT_EQ(error.position(), static_cast<std::int64_t>(size)) << error.what();
    }
  }
}

class ReadMadeC3d : public testing::TestWithParam<const char*> {};

TEST_P(ReadMadeC3d, HasTheKnownPlacesNamesAndGaps) {
  std::vector<std::string> warnings;
  const MarkerSet markers =
      read_c3d_bytes(fixture(std::string("made_") + GetParam()), "made.c3d", {}, collecting(warnings));
  EXPECT_EQ(markers.names, (std::vector<std::string>{"A", "B", "C", "D", "E"}));
  EXPECT_DOUBLE_EQ(markers.frame_rate(), 50);
  EXPECT_DOUBLE_EQ(markers.metres_per_unit, 0.001);
  ASSERT_EQ(markers.num_frames(), 6);
  for (Index t = 0; t < 6; ++t)
    for (int m = 0; m < 5; ++m) {
      ASSERT_EQ(markers.seen(t, m), (m + t) % 7 != 3);
      if (!markers.seen(t, m)) continue;
      const Vector3 p = made_place(m, t);
      EXPECT_EQ(markers.position(t, m), Vector3(p.x(), p.z(), -p.y())) << t << ' ' << m;  // Y_SCREEN = +Z
    }
  ASSERT_EQ(warnings.size(), 1U);  // the angle was left out
  EXPECT_NE(warnings[0].find("angles"), std::string::npos);
}
INSTANTIATE_TEST_SUITE_P(Formats, ReadMadeC3d,
                         testing::Values("intel_int", "intel_real", "dec_int", "dec_real", "sgi_int", "sgi_real"));

TEST(ReadC3d, UpOptionGoesBeforeTheFilesAxes) {
  ReadClipOptions options;
  options.up = UpAxis::kY;
  const MarkerSet markers = read_c3d_bytes(fixture("made_intel_real"), "made.c3d", options);
  EXPECT_EQ(markers.position(0, 0), made_place(0, 0));
}

TEST(ReadC3d, MoreThan255NamesAreInTwoLists) {
  const MarkerSet markers = read_c3d_bytes(fixture("made_many"), "made.c3d");
  ASSERT_EQ(markers.num_markers(), 300);
  EXPECT_EQ(markers.names[254], "P254");
  EXPECT_EQ(markers.names[255], "P255");
  EXPECT_EQ(markers.names[299], "P299");
  EXPECT_EQ(markers.position(0, 299), made_place(299, 0));
}

// One recording in five number formats, from c3d.org; the integers were cut off, not rounded, at a step.
TEST(ReadC3d, FiveFormatsOfOneRecordingAgree) {
  const MarkerSet reference = read_c3d_bytes(fixture("pc_real"), "pc_real.c3d");
  EXPECT_EQ(reference.num_frames(), 89);
  EXPECT_EQ(reference.num_markers(), 36);
  EXPECT_EQ(reference.names[0], "RFT1");
  EXPECT_NEAR(missing_share(reference), 0.0712, 5e-5);
  for (const char* name : {"dec_real", "sgi_real"})
    expect_same_places(read_c3d_bytes(fixture(name), "x.c3d"), reference, 0);
  for (const char* name : {"pc_int", "dec_int"})
    expect_same_places(read_c3d_bytes(fixture(name), "x.c3d"), reference, kScaleOfIntegers * std::sqrt(3));
}

TEST(WriteC3d, IsReadAgain) {
  const MarkerSet markers = some_markers(40, 7);
  MarkerSet again = read_c3d_bytes(write_c3d_bytes(markers), "again.c3d");
  expect_same_places(again, markers, 0);  // the numbers are exact in single precision
  EXPECT_EQ(again.frame_time_secs, markers.frame_time_secs);
  EXPECT_EQ(again.metres_per_unit, markers.metres_per_unit);
  EXPECT_EQ(write_c3d_bytes(again), write_c3d_bytes(markers));
}

TEST(WriteC3d, TakesMoreFramesAndNamesThanSixteenBitsAndOneListHold) {
  const MarkerSet long_one = some_markers(70'001, 1);
  expect_same_places(read_c3d_bytes(write_c3d_bytes(long_one), "long.c3d"), long_one, 0);
  const MarkerSet wide = some_markers(2, 600);
  expect_same_places(read_c3d_bytes(write_c3d_bytes(wide), "wide.c3d"), wide, 0);
}

TEST(WriteC3d, RefusesMarkersWithoutFrames) { EXPECT_THROW(write_c3d_bytes(some_markers(0, 2)), InvalidInput); }

}  // namespace
}  // namespace motex
