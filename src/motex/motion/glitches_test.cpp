// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/glitches.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "motex/core/error.h"
#include "motex/motion/stick_figure.h"

namespace motex {
namespace {

StickFigureOptions lively() {
  StickFigureOptions options;
  options.noise = 0.2;
  options.turn_rate = 1;
  return options;
}

TEST(FindGlitchFrames, RefusesLimitsThatAreNone) {
  GlitchOptions options;
  options.root_acceleration = 0;
  EXPECT_THROW(find_glitch_frames(walk_stick_figure().clip, options), InvalidInput);
}

TEST(FindGlitchFrames, CleanMovementHasNoneAtAnyRate) {
  for (const double rate : {24, 30, 60, 120, 200}) {
    StickFigureOptions options = lively();
    options.frame_rate = rate;
    EXPECT_TRUE(find_glitch_frames(walk_stick_figure(options).clip).empty()) << rate;
  }
  for (const Index frames : {1, 2, 3}) {
    StickFigureOptions options = lively();
    options.num_frames = frames;
    EXPECT_TRUE(find_glitch_frames(walk_stick_figure(options).clip).empty());
  }
}

TEST(FindGlitchFrames, FindsPopsOfThePelvisAndFlipsOfALimbAndNothingElse) {
  Clip clip = walk_stick_figure(lively()).clip;
  clip.set_translation(100, 0, clip.translation(100, 0) + Vector3(0, 6, 0));
  for (Index t = 300; t < 304; ++t)
    clip.set_rotation(t, 4, clip.rotation(t, 4) * Quat(Eigen::AngleAxisd(1.5, Vector3::UnitX())));
  const std::vector<Index> found = find_glitch_frames(clip);
  EXPECT_TRUE(std::binary_search(found.begin(), found.end(), 100));
  for (const Index edge : {299, 300, 303, 304}) EXPECT_TRUE(std::binary_search(found.begin(), found.end(), edge));
  for (const Index t : found) EXPECT_TRUE((t >= 99 && t <= 101) || (t >= 299 && t <= 304)) << t;
}

TEST(FindGlitchFrames, FindsARestPoseInFront) {
  Clip clip = walk_stick_figure(lively()).clip;
  clip.rotations.row(0) = make_clip(clip.skeleton, 1, 1).rotations.row(0);
  const std::vector<Index> found = find_glitch_frames(clip);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front(), 0);
  EXPECT_LE(found.back(), 2);
}

TEST(FindGlitchFrames, DoesNotDependOnTheUnit) {
  Clip clip = walk_stick_figure(lively()).clip;
  clip.set_translation(100, 0, clip.translation(100, 0) + Vector3(0, 6, 0));
  const std::vector<Index> found = find_glitch_frames(clip);
  clip.skeleton.metres_per_unit = 1;
  clip.translations /= 100;
  for (Joint& joint : clip.skeleton.joints) joint.offset /= 100;
  for (EndSite& site : clip.skeleton.end_sites) site.offset /= 100;
  EXPECT_EQ(find_glitch_frames(clip), found);
}

TEST(RangesWithout, LeavesOutFramesAndShortRests) {
  const std::vector<Index> out = {0, 1, 5, 6, 9};
  const auto ranges = ranges_without(20, out, 3);
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_EQ(ranges[0].first, 2);
  EXPECT_EQ(ranges[0].count, 3);
  EXPECT_EQ(ranges[1].first, 10);
  EXPECT_EQ(ranges[1].count, 10);
  EXPECT_EQ(ranges_without(4, {}).size(), 1u);
  EXPECT_TRUE(ranges_without(0, {}).empty());
}

TEST(TravellingJoint, IsTheFirstThatMoves) {
  Clip clip = walk_stick_figure().clip;
  EXPECT_EQ(travelling_joint({&clip, 1}), 0);
  const FrameMatrix path = clip.translations.leftCols(3);
  clip.translations.leftCols(3).setZero();
  EXPECT_EQ(travelling_joint({&clip, 1}), 0);
  clip.translations.middleCols(3, 3) = path;
  EXPECT_EQ(travelling_joint({&clip, 1}), 1);
}

}  // namespace
}  // namespace motex
