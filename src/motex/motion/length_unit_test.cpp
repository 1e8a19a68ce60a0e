// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/length_unit.h"

#include <gtest/gtest.h>

#include "motex/motion/stick_figure.h"

namespace motex {
namespace {

Clip figure(double metres_per_unit) {
  StickFigureOptions options;
  options.num_frames = 60;
  Clip clip = walk_stick_figure(options).clip;
  clip.skeleton.metres_per_unit = metres_per_unit;
  return clip;
}

TEST(LengthUnit, ScaledLengthsAreTheSamePlaces) {
  const Clip before = figure(0.01);
  Clip after = before;
  scale_lengths(after, 0.01);
  EXPECT_DOUBLE_EQ(after.skeleton.metres_per_unit, 1);
  const FrameMatrix places = world_positions(before), scaled = world_positions(after);
  EXPECT_LT((0.01 * places - scaled).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(LengthUnit, KnownUnitsDecide) {
  EXPECT_DOUBLE_EQ(units_per_unit(figure(1).skeleton, figure(0.01).skeleton), 100);
  EXPECT_EQ(units_per_unit(figure(0.01).skeleton, figure(0.01).skeleton), 1);
}

TEST(LengthUnit, BonesDecideWhereAUnitIsUnknown) {
  const Clip to = figure(0);
  Clip from = figure(0);
  scale_lengths(from, 1 / 106.4);
  from.skeleton.metres_per_unit = 1;
  EXPECT_NEAR(units_per_unit(from.skeleton, to.skeleton), 106.4, 1e-9);
  Clip other_shape = from;
  other_shape.skeleton.joints[1].offset *= 1.3;
  EXPECT_EQ(units_per_unit(other_shape.skeleton, to.skeleton), 1);
  Clip grown = figure(1);
  scale_lengths(grown, 1.3);
  EXPECT_EQ(units_per_unit(grown.skeleton, to.skeleton), 1) << "a larger body, not another unit";
}

TEST(LengthUnit, MatchingIsSaid) {
  const Clip to = figure(0);
  Clip clip = figure(0);
  scale_lengths(clip, 1 / 2.54);
  std::vector<std::string> said;
  JobContext job;
  job.on_warning = [&](const std::string& message) { said.push_back(message); };
  match_unit(clip, to.skeleton, job);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said[0].find("multiplied by 2.54"), std::string::npos) << said[0];
  EXPECT_LT((clip.translations - to.translations).cwiseAbs().maxCoeff(), 1e-9);
  match_unit(clip, to.skeleton, job);
  EXPECT_EQ(said.size(), 1U);
}

}  // namespace
}  // namespace motex
