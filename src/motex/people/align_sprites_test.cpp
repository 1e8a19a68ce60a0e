// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/align_sprites.h"

#include <gtest/gtest.h>

#include "motex/people/drawn_actor.h"

namespace motex {
namespace {

TEST(AlignSprites, FindsAShift) {
  const Sprite a = drawn_actor({.x = 100, .ground = 180}), b = drawn_actor({.x = 71, .ground = 190});
  const SpriteAlignment found = align_sprites(a, b);
  EXPECT_EQ(found.placement, (Placement{1, 29, -10}));
  EXPECT_EQ(found.difference, 0);
}

TEST(AlignSprites, FeetLieOnFeetThoughTheBodyLeans) {
  const Sprite a = drawn_actor({}), b = drawn_actor({.x = 90, .lean = 9});
  const SpriteAlignment found = align_sprites(a, b, {1.25, 40});
  EXPECT_NEAR(found.placement.x, 10, 1);
  EXPECT_EQ(found.placement.y, 0);
}

TEST(AlignSprites, ScalesOnlyWhereItHelps) {
  const Sprite a = drawn_actor({}), small = drawn_actor({.scale = 0.85}), arm = drawn_actor({.has_right_arm = false});
  EXPECT_NEAR(align_sprites(a, small).placement.scale, 1 / 0.85, 0.03);
  EXPECT_EQ(align_sprites(a, small, {1, 4}).placement.scale, 1);
  EXPECT_EQ(align_sprites(a, arm).placement.scale, 1);
}

TEST(AlignSprites, OfNobodyThereIsNothingToAlign) {
  EXPECT_EQ(align_sprites(Sprite{}, drawn_actor({})).placement, Placement{});
  EXPECT_EQ(sprite_difference(Sprite{}, Sprite{}), 0);
}

}  // namespace
}  // namespace motex
