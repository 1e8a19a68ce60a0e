// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/flow_warp.h"

#include <gtest/gtest.h>

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
  const auto error = [&](const SpriteFlow& flow) {
    return sprite_difference(flow_morph({a, {}}, {b, {}}, flow, 0.5, 0), flow_morph({a, {}}, {b, {}}, flow, 0.5, 1));
  };
  EXPECT_LT(error(sprite_flow({a, {}}, {b, {}}, lines)), 0.8 * error(sprite_flow({a, {}}, {b, {}})));
}

TEST(FlowWarp, SaysWhereThereIsNoWayThereAndBack) {
  const Sprite a = drawn_actor({.left_arm = 0.2}), b = drawn_actor({.left_arm = 2.8, .right_arm = 2.8, .lean = 20});
  EXPECT_LT(sprite_flow({a, {}}, {b, {}}).consistency, 0.8);
  EXPECT_TRUE(sprite_flow({Sprite{}, {}}, {Sprite{}, {}}).box.empty());
}

}  // namespace
}  // namespace motex
