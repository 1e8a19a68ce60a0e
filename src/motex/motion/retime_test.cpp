// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/retime.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "motex/core/error.h"
#include "motex/motion/stick_figure.h"

namespace motex {
namespace {

Clip walk() {
  StickFigureOptions options;
  options.num_frames = 120;
  return walk_stick_figure(options).clip;
}

TEST(Retime, BadMoments) {
  EXPECT_THROW(retime(walk(), std::vector<double>{std::numeric_limits<double>::quiet_NaN()}), InvalidInput);
  EXPECT_THROW(play_at_speed(walk(), 0), InvalidInput);
  EXPECT_THROW(play_at_speed(slice(walk(), 0, 0), 1), InvalidInput);
}

TEST(Retime, WholeNumbersAreTheFrames) {
  const Clip clip = walk();
  const Clip out = retime(clip, std::vector<double>{3, 0, 119, 200, -1});
  EXPECT_EQ(out.rotations.row(0), clip.rotations.row(3));
  EXPECT_EQ(out.translations.row(2), clip.translations.row(119));
  EXPECT_EQ(out.rotations.row(3), clip.rotations.row(119));
  EXPECT_EQ(out.rotations.row(4), clip.rotations.row(0));
  EXPECT_EQ(play_at_speed(clip, 1).rotations, clip.rotations);
}

TEST(Retime, HalfSpeedTwiceAsLongAndBack) {
  const Clip clip = walk();
  const Clip slow = play_at_speed(clip, 0.5);
  EXPECT_EQ(slow.num_frames(), 239);
  const Clip back = play_at_speed(slow, 2);
  EXPECT_LT((back.rotations - clip.rotations).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(play_at_speed(clip, 4).num_frames(), 30);
}

TEST(Retime, BetweenFramesItIsNearerThanSlerp) {
  // A constant turn and a parabola are met between frames.
  Clip clip = make_clip(stick_figure_skeleton(), 6, 0.1);
  for (Index t = 0; t < 6; ++t) {
    const auto s = static_cast<double>(t);
    clip.set_translation(t, 0, Vector3(s * s, 0, 0));
    clip.set_rotation(t, 0, exp_map(Vector3(0, 0.3 * s, 0)));
  }
  const Clip out = retime(clip, std::vector<double>{2.25});
  EXPECT_NEAR(out.translation(0, 0).x(), 2.25 * 2.25, 1e-12);
  EXPECT_NEAR(angle_between(out.rotation(0, 0), exp_map(Vector3(0, 0.3 * 2.25, 0))), 0, 1e-9);
}

TEST(Retime, SpeedIsContinuous) {
  const Clip slow = play_at_speed(walk(), 0.25);
  const FrameMatrix p = world_positions(slow);
  const auto step = (p.bottomRows(p.rows() - 1) - p.topRows(p.rows() - 1)).eval();
  const auto change = (step.bottomRows(step.rows() - 1) - step.topRows(step.rows() - 1)).eval();
  const FrameMatrix q = world_positions(walk());
  const auto own_step = (q.bottomRows(q.rows() - 1) - q.topRows(q.rows() - 1)).eval();
  const auto own_change = (own_step.bottomRows(own_step.rows() - 1) - own_step.topRows(own_step.rows() - 1)).eval();
  EXPECT_LT(change.cwiseAbs().maxCoeff(), own_change.cwiseAbs().maxCoeff() / 4);  // 1/16 of smooth acceleration
}

}  // namespace
}  // namespace motex
