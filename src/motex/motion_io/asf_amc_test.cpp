// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/asf_amc.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "motex/core/files.h"
#include "motex/motion_io/bvh.h"

namespace motex {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(MOTEX_TEST_DATA) / "mocap" / "asfamc";

const std::string kAsf = R"(:version 1.10
:units
  length 0.5
  angle deg
:root
  order TX TY TZ RX RY RZ
  axis XYZ
  position 0 0 0
  orientation 0 0 0
:bonedata
  begin
    name arm
    direction 2 0 0
    length 3
    axis 0 0 90 XYZ
    dof rx rz
    limits (-10 10)
           (-20 20)
  end
:hierarchy
  begin
    root arm
  end
)";

void expect_error(const std::string& asf, const std::string& amc, int line, const std::string& part) {
  try {
    read_amc_bytes({asf, "s.asf"}, {amc, "s_1.amc"});
    ADD_FAILURE() << "no error; expected: " << part;
  } catch (const ParseError& e) {
    EXPECT_EQ(e.position(), line) << e.what();
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

std::string replaced(std::string text, const std::string& old, const std::string& now) {
  return text.replace(text.find(old), old.size(), now);
}

TEST(AsfAmc, Errors) {
  const std::string frame = ":DEGREES\n1\nroot 0 0 0 0 0 0\narm 1 2\n";
  EXPECT_NO_THROW(read_amc_bytes({kAsf, "s.asf"}, {frame, "s_1.amc"}));
  expect_error("", frame, 1, "empty");
  expect_error(kAsf, "", 1, "empty");
  expect_error(kAsf, ":DEGREES\n", 2, "no frame");
  expect_error(kAsf, "root 1 2 3", 1, "not an AMC");
  expect_error("HIERARCHY\n", frame, 1, "not an ASF");
  expect_error(kAsf, "1\nroot 0 0 0 0 0 0\narm 1\n", 3, "has 1 numbers, the .asf says 2");
  expect_error(kAsf, "1\nleg 1\n", 2, "bone 'leg' is not in the .asf");
  expect_error(kAsf, "1\narm 1 nan\n", 2, "not a finite number");
  expect_error(kAsf, "1\narm 1 2\narm 1 2\n", 3, "stands twice");
  expect_error(kAsf, frame + "2\nroot 0 0 0 0 0 0\n", 7, "frame 1 gives 1 bones, the first frame 2");
  expect_error(replaced(kAsf, "rx rz", "rx rq"), frame, 16, "'rq' is no degree of freedom");
  expect_error(replaced(kAsf, "90 XYZ", "90 XXZ"), frame, 15, "'XXZ' is no order");
  expect_error(replaced(kAsf, "root arm", "arm root"), frame, 22, "two parents");
  expect_error(replaced(kAsf, "root arm", "root arm arm"), frame, 22, "two parents");
  expect_error(replaced(kAsf, "root arm", "root leg"), frame, 22, "no bone 'leg'");
  expect_error(kAsf.substr(0, kAsf.find("limits")), frame, 17, "ends inside a bone");
  EXPECT_THROW(read_amc_bytes({replaced(kAsf, "rx rz", "rx tz"), "s.asf"}, {frame, "a"}), UnsupportedFile);
}

TEST(AsfAmc, AxisFrameTurnsTheAngles) {
  // The axis frame turns z by 90°: the arm's own x is the world's y, about which 90° carry +x to −z.
  std::string warning;
  JobContext job;
  job.on_warning = [&](const std::string& message) { warning = message; };
  const Clip clip = read_amc_bytes({kAsf, "s.asf"}, {"1\nroot 1 2 3 0 0 0\narm 90 0\n", "s_1.amc"}, {}, job);
  const FrameMatrix world = world_positions(clip);
  EXPECT_LT((world.block<1, 3>(0, 3).transpose() - Vector3(1, 2, 3)).norm(), 1e-12);
  EXPECT_LT((world.block<1, 3>(0, 6).transpose() - Vector3(1, 2, 0)).norm(), 1e-12);
  EXPECT_NEAR(clip.skeleton.metres_per_unit, 0.0508, 1e-15);
  EXPECT_DOUBLE_EQ(clip.frame_time_secs, 1.0 / 120);
  EXPECT_NE(warning.find("120 Hz"), std::string::npos);
  EXPECT_EQ(clip.name, "s_1");
}

TEST(AsfAmc, RatesAndRadians) {
  const std::string amc = ":RADIANS\n:SAMPLES-PER-SECOND 60\n1\nroot 0 0 0 0 1.5 0\narm 0 0\n";
  const Clip clip = read_amc_bytes({kAsf, "s.asf"}, {amc, "s.amc"});
  EXPECT_DOUBLE_EQ(clip.frame_time_secs, 1.0 / 60);
  EXPECT_NEAR(angle_between(clip.rotation(0, 0), Quat::Identity()), 1.5, 1e-12);
  ReadClipOptions options;
  options.fps = 30;
  EXPECT_DOUBLE_EQ(read_amc_bytes({kAsf, "s.asf"}, {amc, "s.amc"}, options).frame_time_secs, 1.0 / 30);
}

// positions.txt comes from tests/data/mocap/make_positions_amc.py, which shares nothing with motex.
TEST(AsfAmc, PositionsAgreeWithIndependentComputation) {
  const Clip clip = read_amc(kFolder / "11_01.amc");
  EXPECT_EQ(clip.num_frames(), 12);
  EXPECT_EQ(clip.skeleton.num_joints(), 31);
  EXPECT_NEAR(clip.skeleton.metres_per_unit, 0.0254 / 0.45, 1e-12);
  const FrameMatrix world = world_positions(clip);
  std::ifstream lines(kFolder / "positions.txt");
  Index frame = 0;
  int count = 0;
  Vector3 end;
  for (std::string bone; lines >> frame >> bone >> end.x() >> end.y() >> end.z(); ++count) {
    // A bone's end is where its children, or its end site, are.
    const int joint = clip.skeleton.find(bone);
    Index column = -1;
    if (joint == 0) column = 0;
    for (int j = clip.skeleton.num_joints() - 1; j > 0 && joint > 0; --j)
      if (clip.skeleton.joints[static_cast<std::size_t>(j)].parent_idx == joint) column = 3 * j;
    for (std::size_t e = 0; e < clip.skeleton.end_sites.size(); ++e)
      if (clip.skeleton.end_sites[e].parent_idx == joint) column = 3 * (31 + static_cast<Index>(e));
    ASSERT_GE(column, 0) << bone;
    EXPECT_LT((world.block<1, 3>(frame, column).transpose() - end).norm(), 1e-6) << frame << " " << bone;
  }
  EXPECT_EQ(count, 62);
}

TEST(AsfAmc, WritesToBvh) {
  const Clip clip = read_amc(kFolder / "11_01.amc");
  const Clip again = read_bvh_bytes(write_bvh_bytes(clip), "again.bvh");
  EXPECT_LT((world_positions(clip) - world_positions(again)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(AsfAmc, FindsTheSkeleton) {
  const auto folder = std::filesystem::temp_directory_path() / "motex_asf_amc_test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  write_file(folder / "7_1.amc", "1\nroot 0 0 0 0 0 0\narm 1 2\n");
  EXPECT_THROW(read_amc(folder / "7_1.amc"), InvalidInput);
  write_file(folder / "any.asf", kAsf);
  EXPECT_EQ(read_amc(folder / "7_1.amc").num_frames(), 1);
  write_file(folder / "other.asf", "broken");
  EXPECT_THROW(read_amc(folder / "7_1.amc"), InvalidInput);
  write_file(folder / "7.asf", kAsf);
  EXPECT_EQ(read_amc(folder / "7_1.amc").num_frames(), 1);
  ReadClipOptions options;
  options.asf = (folder / "other.asf").string();
  EXPECT_THROW(read_amc(folder / "7_1.amc", options), ParseError);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace motex
