// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/crowd.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/motion/stick_figure.h"

namespace motex {
namespace {

TEST(Crowd, NobodyIsAnError) { EXPECT_THROW(side_by_side({}, 1), InvalidInput); }

TEST(Crowd, BodiesMoveAsBeforeAndKeepApart) {
  StickFigureOptions options;
  options.num_frames = 60;
  const Clip one = walk_stick_figure(options).clip;
  options.num_frames = 90;
  options.turn_rate = 0.8;
  const Clip two = walk_stick_figure(options).clip;
  const Clip both = side_by_side(std::vector<Clip>{one, two}, 50);
  check_clip(both);
  EXPECT_EQ(both.num_frames(), 90);
  EXPECT_GE(both.skeleton.find("d2:Hips"), one.skeleton.num_joints());
  const int n = one.skeleton.num_joints();
  const FrameMatrix all = world_positions(both);
  const FrameMatrix first = all.leftCols(3 * n), second = all.middleCols(3 * n, 3 * n);
  const FrameMatrix alone = world_positions(two).leftCols(3 * n);
  const double shift = second(0, 0) - alone(0, 0);
  double high = -1e9, low = 1e9, off = 0;
  for (Index t = 0; t < 90; ++t)
    for (Index j = 0; j < 3 * n; j += 3) {
      high = std::max(high, first(t, j));
      low = std::min(low, second(t, j));
      off = std::max(off, std::abs(second(t, j) - shift - alone(t, j)));
    }
  EXPECT_GE(low - high, 49.9);
  EXPECT_LT(off, 1e-9);
  EXPECT_EQ(first.row(89), first.row(59));  // the shorter one stands still
}

}  // namespace
}  // namespace motex
