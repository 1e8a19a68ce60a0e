// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/bvh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "motex/core/files.h"

namespace motex {
namespace {

const std::filesystem::path kMocap = std::filesystem::path(MOTEX_TEST_DATA) / "mocap";

struct Read {
  Clip clip;
  std::vector<std::string> warnings;
};

Read read(const std::string& text, const ReadClipOptions& options = {}) {
  Read result;
  JobContext job;
  job.on_warning = [&](const std::string& message) { result.warnings.push_back(message); };
  result.clip = read_bvh_bytes(text, "folder/test.bvh", options, job);
  check_clip(result.clip);
  return result;
}

std::string synthetic(const std::string& name) { return read_file(kMocap / "synthetic" / (name + ".bvh")); }

// What a reader of the message sees, and the line it points to.
void expect_error(const std::string& text, int line, const std::string& part) {
  try {
    read(text);
    ADD_FAILURE() << "no error; expected: " << part;
  } catch (const ParseError& e) {
    EXPECT_EQ(e.position(), line) << e.what();
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

struct Expectation {
  const char* file;
  int frames;        // 0: an error
  int line;          // of the error
  const char* text;  // part of the error or of the only warning; "" = no warning
};

// Every file of tests/data/mocap/synthetic.
constexpr Expectation kSynthetic[] = {
    {"all_frames_identical", 60, 0, ""},
    {"binary_garbage", 0, 1, "not a BVH file"},
    {"chain_300_deep_no_root_position", 3, 0, ""},
    {"comma_decimals", 30, 0, "decimal commas"},
    {"cr_only_newlines", 30, 0, ""},
    {"crlf_and_trailing_blank_lines", 30, 0, ""},
    {"duplicate_joint_names", 30, 0, "renamed, the first to 'Hips_2'"},
    {"empty", 0, 1, "empty"},
    {"frame_wrapped_over_two_lines", 30, 0, "wrapped over several lines, the first at line 19"},
    {"header_says_fewer_frames", 30, 0, "states 10 frames, the file holds 30"},
    {"header_says_more_frames", 30, 0, "states 100 frames, the file holds 30"},
    {"huge_frame_count_header", 30, 0, "states 4294967296 frames, the file holds 30"},
    {"joint_name_with_spaces", 30, 0, ""},
    {"leaf_without_end_site", 30, 0, "the first 'Spine'"},
    {"lower_case_keywords", 30, 0, ""},
    {"missing_closing_brace", 0, 15, "the '{' of line 3 has no '}'"},
    {"nan_and_inf_values", 0, 26, "'nan' is not a finite number"},
    {"negative_frame_time", 0, 18, "--fps"},
    {"no_motion_section", 0, 16, "ends before its MOTION"},
    {"not_a_bvh_but_named_so", 0, 1, "not a BVH file"},
    {"ok_reference", 30, 0, ""},
    {"text_in_row", 0, 24, "'#' stands where a number of frame 5 should be"},
    {"truncated_mid_row", 0, 48, "ends inside frame 29, after 4 of its 9"},
    {"utf8_bom", 30, 0, ""},
    {"zero_frame_time", 0, 18, "--fps"},
    {"zero_frames", 0, 19, "no frame"},
};

TEST(BvhRead, EverySyntheticFile) {
  const Clip reference = read(synthetic("ok_reference")).clip;
  std::size_t num_files = 0;
  for (const auto& file : std::filesystem::directory_iterator(kMocap / "synthetic"))
    num_files += file.path().extension() == ".bvh";
  EXPECT_EQ(num_files, std::size(kSynthetic));
  for (const Expectation& expected : kSynthetic) {
    SCOPED_TRACE(expected.file);
    if (expected.frames == 0) {
      expect_error(synthetic(expected.file), expected.line, expected.text);
      continue;
    }
    const Read got = read(synthetic(expected.file));
    EXPECT_EQ(got.clip.num_frames(), expected.frames);
    ASSERT_EQ(got.warnings.size(), expected.text[0] == '\0' ? 0U : 1U);
    if (!got.warnings.empty()) {
      EXPECT_NE(got.warnings[0].find(expected.text), std::string::npos) << got.warnings[0];
    }
    // All but these two are the reference in other clothes.
    const std::string name = expected.file;
    if (name == "all_frames_identical" || name == "chain_300_deep_no_root_position") continue;
    EXPECT_EQ(got.clip.rotations, reference.rotations);
    EXPECT_EQ(got.clip.translations, reference.translations);
    EXPECT_EQ(got.clip.frame_time_secs, reference.frame_time_secs);
  }
}

TEST(BvhRead, FpsMendsFrameTime) {
  ReadClipOptions options;
  options.fps = 50;
  for (const char* file : {"zero_frame_time", "negative_frame_time", "ok_reference"})
    EXPECT_EQ(read(synthetic(file), options).clip.frame_time_secs, 0.02);
}

TEST(BvhRead, NamesAndChannels) {
  const Clip clip = read(synthetic("joint_name_with_spaces")).clip;
  EXPECT_EQ(clip.name, "test");
  EXPECT_EQ(clip.skeleton.joints[1].name, "mixamorig:Spine 1");
  EXPECT_EQ(clip.skeleton.joints[0].channels.size(), 6U);
  EXPECT_EQ(clip.skeleton.joints[1].channels[1], Channel::kXRotation);
  ASSERT_EQ(clip.skeleton.end_sites.size(), 1U);
  EXPECT_EQ(clip.skeleton.end_sites[0].offset, Vector3(0, 10, 0));
}

std::string hierarchy(const std::string& root, const std::string& rest) {
  return "HIERARCHY\nROOT a\n{\nOFFSET 1 2 3\n" + root + "\n}\nMOTION\n" + rest;
}

TEST(BvhRead, RenamedJointsStayApart) {
  const auto joint = [](const std::string& name) { return "JOINT " + name + "\n{\nOFFSET 0 1 0\n}\n"; };
  const Read got = read(hierarchy("CHANNELS 1 Xrotation\n" + joint("a_2") + joint("a") + joint("a") + joint(""),
                                  "Frames: 1\nFrame Time: 1\n5\n"));
  const auto& joints = got.clip.skeleton.joints;
  EXPECT_EQ(joints[1].name, "a_2");
  EXPECT_EQ(joints[2].name, "a_3");
  EXPECT_EQ(joints[3].name, "a_4");
  EXPECT_EQ(joints[4].name, "joint4");
  EXPECT_EQ(got.warnings.size(), 3U);
}

TEST(BvhRead, Errors) {
  const std::string channels = "CHANNELS 3 Zrotation Xrotation Yrotation";
  const std::string header = "Frames: 1\nFrame Time: .1\n";
  EXPECT_NO_THROW(read(hierarchy(channels, header + "1 2 3")));
  expect_error(hierarchy(channels, header + "1 2 3 4\n"), 10, "too many or too few");
  expect_error(hierarchy(channels, header + "1 2\n3 4 5\n"), 11, "too many or too few");
  expect_error(hierarchy(channels, header + "1 2 x3\n"), 10, "'x3' stands where");
  expect_error(hierarchy(channels, header + "1 2 1e400\n"), 10, "not a finite number");
  expect_error(hierarchy(channels, header + "1 2 1e20\n"), 10, "too large");
  expect_error(hierarchy(channels, "Frames: 1\nFrame Tim"), 9, "expected 'Frame Time:'");
  expect_error(hierarchy(channels, "Frames: many\n"), 8, "'many' stands where");
  expect_error(hierarchy(channels, ""), 8, "ends where 'Frames:'");
  expect_error(hierarchy("CHANNELS 7 Xrotation", header), 5, "0 to 6");
  expect_error(hierarchy("CHANNELS -1", header), 5, "0 to 6");
  expect_error(hierarchy("CHANNELS 2 Xposition Xposition", header), 5, "Xposition once too often");
  expect_error(hierarchy("CHANNELS 2 Xrotation Xrotation", header), 5, "Xrotation once too often");
  expect_error(hierarchy("CHANNELS 1 Wrotation", header), 5, "'Wrotation' is no channel");
  expect_error(hierarchy("CHANNELS 0", header), 7, "nothing can move");
  expect_error(hierarchy(channels + "\nROOT b", header), 6, "'ROOT' has no place here");
  expect_error("HIERARCHY\nJOINT a\n{\n", 2, "'JOINT' has no place here, outside of any ROOT");
  expect_error("HIERARCHY\nROOT a\nOFFSET 0 0 0\n", 3, "expected '{' after joint 'a'");
  expect_error("HIERARCHY\nROOT a\n{\nOFFSET 0 0", 4, "the file ends where a number of OFFSET");
  expect_error("HIERARCHY\nMOTION\n", 2, "no ROOT");
  expect_error("\xFF\xFEH", 1, "UTF-16");
}

TEST(BvhRead, DeepAndManyAreBounded) {
  std::string deep = "HIERARCHY\n", end;
  for (int j = 0; j < 10'001; ++j) {
    deep +=
        (j == 0 ? "ROOT j\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n" : "JOINT j\n{\nOFFSET 0 1 0\n");
    if (j < 9'999) end += "}\n";
  }
  expect_error(deep, 30'003, "more than 10,000 joints");
  // Few bytes a frame and thousands of joints without channels ask for gigabytes.
  std::string greedy = "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n";
  for (int j = 0; j < 5'000; ++j) greedy += "JOINT " + std::to_string(j) + " {OFFSET 0 1 0 End Site {OFFSET 0 1 0}}\n";
  greedy += "}\nMOTION\nFrames: 1\nFrame Time: 1\n";
  for (int t = 0; t < 20'000; ++t) greedy += "1\n";
  EXPECT_THROW(read(greedy), ParseError);
}

TEST(BvhRead, PositionsReplaceOffsetAxisByAxis) {
  const Clip clip = read(hierarchy("CHANNELS 2 Yposition Xrotation\nJOINT b\n{\nOFFSET 4 5 6\nCHANNELS 1 Zposition\n}",
                                   "Frames: 1\nFrame Time: .1\n7 90 8\n"))
                        .clip;
  EXPECT_EQ(clip.translation(0, 0), Vector3(1, 7, 3));
  EXPECT_EQ(clip.translation(0, 1), Vector3(4, 5, 8));
  const FrameMatrix world = world_positions(clip);
  EXPECT_LT((world.block<1, 3>(0, 3).transpose() - Vector3(5, -1, 8)).norm(), 1e-12);
}

// positions.txt comes from tests/data/mocap/make_positions.py, which shares nothing with motex.
TEST(BvhRead, PositionsAgreeWithIndependentComputation) {
  std::ifstream lines(kMocap / "wild" / "positions.txt");
  std::string line, file;
  FrameMatrix world;
  int num_lines = 0;
  for (std::string last; std::getline(lines, line); ++num_lines) {
    std::istringstream words(line);
    Index frame = 0;
    words >> file >> frame;
    if (file != last) {
      for (const char* folder : {"wild", "quickstart", "synthetic"})
        if (exists(kMocap / folder / file)) world = world_positions(read_bvh(kMocap / folder / file));
      last = file;
    }
    Index column = 0;
    for (double expected = 0; words >> expected; ++column)
      ASSERT_NEAR(world(frame, column), expected, 1e-6 + 1e-8 * std::abs(expected)) << file << " frame " << frame;
    ASSERT_EQ(column, world.cols()) << file;
  }
  EXPECT_GE(num_lines, 30);
}

void expect_same_skeleton(const Skeleton& a, const Skeleton& b) {
  ASSERT_EQ(skeleton_difference(a, b), "");
  for (std::size_t j = 0; j < a.joints.size(); ++j) {
    EXPECT_EQ(a.joints[j].offset, b.joints[j].offset);
    EXPECT_EQ(a.joints[j].channels, b.joints[j].channels);
  }
  ASSERT_EQ(a.end_sites.size(), b.end_sites.size());
  for (std::size_t e = 0; e < a.end_sites.size(); ++e) {
    EXPECT_EQ(a.end_sites[e].parent_idx, b.end_sites[e].parent_idx);
    EXPECT_EQ(a.end_sites[e].offset, b.end_sites[e].offset);
  }
}

TEST(BvhWrite, ReadBackIsTheSame) {
  for (const char* folder : {"wild", "quickstart"})
    for (const auto& file : std::filesystem::directory_iterator(kMocap / folder)) {
      if (file.path().extension() != ".bvh") continue;
      SCOPED_TRACE(file.path());
      const Clip clip = read_bvh(file.path());
      const std::string bytes = write_bvh_bytes(clip);
      const Clip again = read_bvh_bytes(bytes, "again.bvh");
      expect_same_skeleton(clip.skeleton, again.skeleton);
      EXPECT_EQ(clip.frame_time_secs, again.frame_time_secs);
      ASSERT_EQ(clip.num_frames(), again.num_frames());
      EXPECT_LT((world_positions(clip) - world_positions(again)).cwiseAbs().maxCoeff(), 1e-6);
      EXPECT_EQ(write_bvh_bytes(again), bytes);
    }
}

Clip two_joints() {
  Skeleton skeleton;
  skeleton.joints = {{"root", -1, Vector3(0, 1, 0), {}}, {"tip", 0, Vector3(0, 2, 0), {}}};
  skeleton.end_sites = {{1, Vector3(0.1, 0.2, 0.3)}, {0, Vector3(0, -1, 0)}};
  return make_clip(skeleton, 40, 1.0 / 3);
}

TEST(BvhWrite, AddsTheChannelsThatTheMotionNeeds) {
  Clip clip = two_joints();
  const Clip still = read_bvh_bytes(write_bvh_bytes(clip), "still.bvh");
  EXPECT_EQ(still.skeleton.joints[0].channels.size(), 6U);  // without any channel there would be no frame
  EXPECT_EQ(still.translations, clip.translations);
  for (Index t = 0; t < clip.num_frames(); ++t) {
    clip.set_rotation(t, 0, exp_map(0.2 * static_cast<double>(t) * Vector3(1, 0.5, 0)));
    clip.set_translation(t, 1, Vector3(0, 2, 0.1 * static_cast<double>(t)));
  }
  const Clip again = read_bvh_bytes(write_bvh_bytes(clip), "again.bvh");
  EXPECT_EQ(again.skeleton.joints[0].channels.size(), 3U);
  EXPECT_EQ(again.skeleton.joints[1].channels.size(), 3U);
  EXPECT_LT((world_positions(clip) - world_positions(again)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(again.skeleton.end_sites[0].parent_idx, 1);
  EXPECT_EQ(again.frame_time_secs, clip.frame_time_secs);
}

TEST(BvhWrite, OneAndTwoAnglesArePreserved) {
  Clip clip = two_joints();
  clip.skeleton.joints[0].channels = {Channel::kYRotation};
  clip.skeleton.joints[1].channels = {Channel::kXRotation, Channel::kZRotation};
  for (Index t = 0; t < clip.num_frames(); ++t) {  // through ±90°, ±180° and whole turns of both
    const double angle = 0.4 * static_cast<double>(t);
    clip.set_rotation(t, 0, quat_from_euler({{1, 2, 0}}, Vector3(angle, 0, 0)));
    clip.set_rotation(t, 1, quat_from_euler({{0, 2, 1}}, Vector3(angle, -0.7 * angle, 0)));
  }
  const Clip again = read_bvh_bytes(write_bvh_bytes(clip), "again.bvh");
  expect_same_skeleton(clip.skeleton, again.skeleton);
  EXPECT_LT((world_positions(clip) - world_positions(again)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(BvhWrite, AnglesDoNotJump) {
  Clip clip = two_joints();
  for (Joint& joint : clip.skeleton.joints)
    joint.channels = {Channel::kZRotation, Channel::kXRotation, Channel::kYRotation};
  for (Index t = 0; t < clip.num_frames(); ++t)
    clip.set_rotation(t, 0, exp_map(Vector3(0, 0.5 * static_cast<double>(t), 0)));  // three turns
  const std::string text = write_bvh_bytes(clip);
  std::istringstream rows(text.substr(text.find('\n', text.find("Frame Time")) + 1));
  double last = 0, angle = 0, skip = 0;
  for (Index t = 0; t < clip.num_frames(); ++t, last = angle) {
    rows >> skip >> skip >> angle >> skip >> skip >> skip;
    EXPECT_LT(std::abs(angle - last), 30) << t;
  }
  EXPECT_GT(std::abs(angle), 1000);
}

TEST(BvhWrite, RefusesWhatCannotBeRead) {
  Clip clip = two_joints();
  clip.rotations(3, 1) = std::nan("");
  EXPECT_THROW(write_bvh_bytes(clip), InvalidInput);
  EXPECT_THROW(write_bvh_bytes(make_clip(two_joints().skeleton, 0, 1)), InvalidInput);
}

}  // namespace
}  // namespace motex
