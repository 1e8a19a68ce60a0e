// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/cut_quality.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/people/drawn_actor.h"

namespace motex {
namespace {

std::vector<Sprite> walk(int num_frames, int jump_at, double jump) {
  std::vector<Sprite> frames;
  for (int t = 0; t < num_frames; ++t) frames.push_back(drawn_actor({.x = 70 + 2 * t + (t >= jump_at ? jump : 0)}));
  return frames;
}

TEST(CutQuality, NeedsTwoFramesAtEachSide) { EXPECT_THROW(cut_quality(walk(3, 9, 0), {}), InvalidInput); }

TEST(CutQuality, IsPerfectForEvenMotionAndSeesAJump) {
  const SecondDifferenceScales scales{10, 0.5, 0.01};
  const CutQuality even = cut_quality(walk(8, 9, 0), scales), jump = cut_quality(walk(8, 4, 10), scales);
  EXPECT_LT(even.smoothness.centroid, 0.05);
  EXPECT_NEAR(jump.smoothness.centroid, 10 / 0.5, 0.5);
  EXPECT_EQ(jump.smoothness.area, even.smoothness.area);
  EXPECT_LT(even.flow_error, jump.flow_error);
}

TEST(CutQuality, SimilarityIsOneForEqualPicturesAndFallsWithDistance) {
  const Sprite a = drawn_actor({});
  EXPECT_NEAR(sprite_ssim(a, a), 1, 1e-6);
  const double near = sprite_ssim(a, drawn_actor({.x = 101})), far = sprite_ssim(a, drawn_actor({.x = 106}));
  EXPECT_LT(near, 1);
  EXPECT_LT(far, near);
  EXPECT_EQ(sprite_ssim(Sprite{}, Sprite{}), 1);
}

TEST(CutQuality, FlowExplainsAMoveButNotAFade) {
  const Sprite a = drawn_actor({.right_arm = 1.2});
  const double moved = flow_warp_error(a, drawn_actor({.x = 102, .right_arm = 1.2}));
  const double faded = flow_warp_error(a, drawn_actor({.right_arm = 1.2, .has_right_arm = false}));
  EXPECT_LT(moved, 8);
  EXPECT_GT(faded, 1.5 * moved);
}

}  // namespace
}  // namespace motex
