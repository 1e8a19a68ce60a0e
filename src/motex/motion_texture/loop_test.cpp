// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/loop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/motion_texture/placing.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

TEST(Loop, BadRequests) {
  LoopReport report;
  EXPECT_THROW(synthesize_loop(sample_model(), 1, RootStep::Zero(), {}, report), InvalidInput);
  EXPECT_THROW(synthesize_loop(sample_model(), 300, RootStep(NAN, 0, 0), {}, report), InvalidInput);
}

TEST(Loop, TheFirstFrameFollowsTheLastInPlaceAndOnTheWay) {
  const FeatureSpace& space = sample_model().features;
  for (const RootStep& step : {RootStep(0, 0, 0), RootStep(20, 300, 0.4)})
    for (const bool fixed : {false, true}) {
      ChoreographyOptions options;
      options.foot_fix = options.floor_fix = fixed;
      LoopReport report;
      const Clip loop = synthesize_loop(sample_model(), 240, step, options, report);
      ASSERT_EQ(loop.num_frames(), 240);
      // Played twice, the seam is a step like others: of pose and of root.
      const Clip twice = repeat_loop(space, loop, step, 2);
      const FrameMatrix p = world_positions(twice);
      const auto speed = [&](Index t) { return (p.row(t + 1) - p.row(t)).norm(); };
      double fastest = 0;
      for (Index t = 0; t < 238; ++t) fastest = std::max(fastest, speed(t));
      EXPECT_LE(speed(239), 1.05 * fastest);
      EXPECT_LE(report.seam_ratio, fixed ? 1.2 : 1.0);
      // The second round begins one step on.
      const RootStep made = root_step(space, root_place(space, twice, 0), root_place(space, twice, 240));
      EXPECT_NEAR(made[0], step[0], 1e-6);
      EXPECT_NEAR(made[1], step[1], 1e-6);
      EXPECT_NEAR(std::remainder(made[2] - step[2], 6.283185307179586), 0, 1e-9);
    }
}

TEST(Loop, SameSeedSameLoop) {
  LoopReport report;
  ChoreographyOptions options;
  const Clip a = synthesize_loop(sample_model(), 200, RootStep::Zero(), options, report);
  const Clip b = synthesize_loop(sample_model(), 200, RootStep::Zero(), options, report);
  EXPECT_EQ(a.rotations, b.rotations);
  options.seed = 9;
  EXPECT_NE(a.rotations, synthesize_loop(sample_model(), 200, RootStep::Zero(), options, report).rotations);
}

TEST(Loop, AtAnotherSpeedItIsStillALoop) {
  const FeatureSpace& space = sample_model().features;
  LoopReport report;
  const RootStep step(0, 200, 0);
  const Clip loop = synthesize_loop(sample_model(), 240, step, {}, report);
  const Clip slow = loop_at_speed(space, loop, step, 0.5);
  ASSERT_EQ(slow.num_frames(), 480);
  const FrameMatrix p = world_positions(repeat_loop(space, loop, step, 2));
  const FrameMatrix q = world_positions(repeat_loop(space, slow, step, 2));
  EXPECT_LT((q.row(480) - p.row(240)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((q.row(482) - p.row(241)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((q.row(478) - p.row(239)).cwiseAbs().maxCoeff(), 1e-6);
}

}  // namespace
}  // namespace motex
