// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/flow_warp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motex/people/align_sprites.h"
#include "motex/people/drawn_actor.h"
#include "motex/people/feature_lines.h"

namespace motex {
namespace {

TEST(FlowWarp, FollowsASmallMove) {
  const Sprite a = drawn_actor({}), b = drawn_actor({.x = 103, .left_arm = 0.65});
  const SpriteFlow flow = sprite_flow({a, {}}, {b, {}});
  EXPECT_GT(flow.consistency, 0.95);
  EXPECT_NEAR(flow.a_to_b.at(100, 110).x, 3, 0.3);
  EXPECT_NEAR(flow.b_to_a.at(103, 110).x, -3, 0.3);
  EXPECT_LT(sprite_difference(flow_morph({a, {}}, {b, {}}, flow, 1, 0), b), 0.5 * sprite_difference(a, b));
}

TEST(FlowWarp, LeavesTheEndsAsTheyAre) {
  const Sprite a = drawn_actor({}), b = drawn_actor({.x = 103, .left_arm = 0.65});
  const SpriteFlow flow = sprite_flow({a, {}}, {b, {}});
  EXPECT_EQ(sprite_difference(flow_morph({a, {}}, {b, {}}, flow, 0, 0), a), 0);
  EXPECT_EQ(sprite_difference(flow_morph({a, {}}, {b, {}}, flow, 1, 1), b), 0);
}

TEST(FlowWarp, BeginsWhereFeatureLinesSay) {
  const Sprite a = drawn_actor({}), b = drawn_actor({.left_arm = 1.4, .right_arm = 0.3, .lean = 10});
  const std::vector<FeatureLinePair> lines = outline_lines({a, {}}, {b, {}});
  // From the left hand of a, an arm of 50 pixels raised from 0.6 to 1.4, to that of b.
  const double x = 86 - 50 * std::sin(0.6), y = 85 + 50 * std::cos(0.6);
  const double move_x = 96 - 50 * std::sin(1.4) - x, move_y = 85 + 50 * std::cos(1.4) - y;
  const auto error = [&](const SpriteFlow& flow) {
    const auto moved = flow.a_to_b.at(x, y);
    return std::hypot(moved.x - move_x, moved.y - move_y);
  };
  EXPECT_LT(error(sprite_flow({a, {}}, {b, {}}, lines)), 0.4 * error(sprite_flow({a, {}}, {b, {}})));
}

TEST(FlowWarp, HoldsOnToTheLinesWhereFlowIsLost) {
  const Sprite a = drawn_actor({.left_arm = 0.2}), b = drawn_actor({.left_arm = 2.8, .right_arm = 2.8, .lean = 20});
  const std::vector<FeatureLinePair> lines = outline_lines({a, {}}, {b, {}});
  // How much the displacement changes from one grid point to the next: a tear is a leap.
  const auto largest_leap = [](const WarpGrid& grid) {
    double leap = 0;
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 1; column < grid.columns; ++column) {
        const std::size_t i = grid.index(column, row);
        leap = std::max(leap, std::hypot(grid.x[i] - grid.x[i - 1], grid.y[i] - grid.y[i - 1]) * 1.0);
      }
    return leap;
  };
  EXPECT_LT(largest_leap(sprite_flow({a, {}}, {b, {}}, lines).a_to_b),
            0.7 * largest_leap(sprite_flow({a, {}}, {b, {}}).a_to_b));
}

TEST(FlowWarp, SaysWhereThereIsNoWayThereAndBack) {
  const Sprite a = drawn_actor({.left_arm = 0.2}), b = drawn_actor({.left_arm = 2.8, .right_arm = 2.8, .lean = 20});
  EXPECT_LT(sprite_flow({a, {}}, {b, {}}).consistency, 0.8);
  EXPECT_TRUE(sprite_flow({Sprite{}, {}}, {Sprite{}, {}}).box.empty());
}

}  // namespace
}  // namespace motex
