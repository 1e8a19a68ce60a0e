// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/warp_sprites.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/people/align_sprites.h"
#include "motex/people/drawn_actor.h"

namespace motex {
namespace {

WarpGrid still(const BoundingBox& box) { return {box.left, box.top, box.width(), box.height(), 8}; }

TEST(WarpSprites, RefusesAGridThatDoesNotCoverAndAPlacementWithoutSize) {
  const Sprite actor = drawn_actor({});
  const BoundingBox box = box_of(actor);
  const WarpGrid fits = still(box), small(box.left, box.top, 20, 20, 8);
  EXPECT_THROW(dissolved({{actor, {}}, fits}, {{actor, {}}, small}, 0.5, box), InvalidInput);
  EXPECT_THROW(placed(actor, {0, 0, 0}), InvalidInput);
  EXPECT_THROW(placed(actor, {1, std::nan(""), 0}), InvalidInput);
}

TEST(WarpSprites, WholePixelsAreNotResampled) {
  const Sprite actor = drawn_actor({}), there = placed(actor, {1, -7, 3});
  EXPECT_EQ(there.left, actor.left - 7);
  EXPECT_EQ(there.top, actor.top + 3);
  EXPECT_EQ(there.pixels, actor.pixels);
}

TEST(WarpSprites, HalfAPixelThereAndBackChangesLittle) {
  const Sprite actor = drawn_actor({});
  const Sprite back = placed(placed(actor, {1, 0.5, 0.5}), {1, -0.5, -0.5});
  EXPECT_LT(sprite_difference(actor, back), 10);
  EXPECT_GT(sprite_difference(actor, placed(actor, {1, 0.5, 0.5})), 15);
  for (const PremultipliedRgba& pixel : back.pixels)
    for (std::size_t c = 0; c < 3; ++c) ASSERT_LE(pixel[c], pixel[3]);
}

TEST(WarpSprites, ScalesAboutTheOriginOfTheFilm) {
  const Sprite actor = drawn_actor({}), large = placed(actor, {1.2, 0, 0});
  EXPECT_NEAR(large.width, 1.2 * actor.width, 2);
  EXPECT_NEAR(large.left, 1.2 * actor.left, 1.5);
  EXPECT_LT(sprite_difference(placed(large, {1 / 1.2, 0, 0}), actor), 10);
}

TEST(WarpSprites, WithoutWarpADissolveIsTheWeightedMean) {
  const Sprite a = drawn_actor({}), b = drawn_actor({.x = 104});
  const BoundingBox box = joined(box_of(a), box_of(b));
  const WarpGrid grid = still(box);
  EXPECT_EQ(sprite_difference(dissolved({{a, {}}, grid}, {{b, {}}, grid}, 0, box), a), 0);
  EXPECT_EQ(sprite_difference(dissolved({{a, {}}, grid}, {{b, {}}, grid}, 1, box), b), 0);
  const Sprite half = dissolved({{a, {}}, grid}, {{b, {}}, grid}, 0.5, box);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      const auto alpha = [&](const Sprite& s) {
        const int u = half.left + x - s.left, v = half.top + y - s.top;
        return u >= 0 && v >= 0 && u < s.width && v < s.height ? s.at(u, v)[3] : 0;
      };
      ASSERT_NEAR(half.at(x, y)[3], (alpha(a) + alpha(b)) / 2.0, 0.51);
      ASSERT_LE(half.at(x, y)[0], half.at(x, y)[3]);
    }
  }
}

TEST(WarpSprites, AWarpShowsWhatLiesAtItsDisplacement) {
  const Sprite a = drawn_actor({});
  const BoundingBox box = joined(box_of(a), box_of(a, {1, 9, -6}));
  WarpGrid grid = still(box);
  for (float& x : grid.x) x = -9;
  for (float& y : grid.y) y = 6;
  EXPECT_EQ(sprite_difference(dissolved({{a, {}}, grid}, {{a, {}}, grid}, 0.3, box), placed(a, {1, 9, -6})), 0);
  const WarpGrid none = still(box);
  EXPECT_EQ(
      sprite_difference(dissolved({{a, {1, 9, -6}}, none}, {{a, {1, 9, -6}}, none}, 0, box), placed(a, {1, 9, -6})), 0);
}

TEST(WarpSprites, WhereTheFrameCutsTheActorOffHisEdgeGoesOn) {
  Sprite a = drawn_actor({.ground = 230});  // the frame ends at 200
  EXPECT_EQ(a.top + a.height, 200);
  const CutOffSides sides = cut_off_sides(a, 200, 200);
  EXPECT_TRUE(sides.bottom);
  EXPECT_FALSE(sides.left || sides.top || sides.right);
  const BoundingBox box = box_of(a);
  WarpGrid grid = still(box);
  for (float& y : grid.y) y = 5;
  const PlacedSprite cut_off{a, {}, sides}, whole{a, {}};
  const Sprite goes_on = dissolved({cut_off, grid}, {cut_off, grid}, 0, box);
  const Sprite ends = dissolved({whole, grid}, {whole, grid}, 0, box);
  const auto row = [](const Sprite& sprite) {
    int sum = 0;
    for (int x = 0; x < sprite.width; ++x) sum += sprite.at(x, sprite.height - 1)[3];
    return sum;
  };
  EXPECT_EQ(row(goes_on), row(a));
  EXPECT_EQ(row(ends), 0);
}

}  // namespace
}  // namespace motex
