// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/feature_lines.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "motex/core/error.h"
#include "motex/people/drawn_actor.h"

namespace motex {
namespace {

PlacedSprite as_it_is(const Sprite& sprite) { return {sprite, {}}; }

bool has_tip_near(const Outline& outline, double x, double y) {
  return std::any_of(outline.tips.begin(), outline.tips.end(),
                     [&](int tip) { return std::hypot(outline.point(tip).x - x, outline.point(tip).y - y) < 10; });
}

TEST(Outline, HasTheHeadHandsAndFeetForTips) {
  const Sprite actor = drawn_actor({.left_arm = 1.2, .right_arm = 1.2, .stride = 20});
  const Outline outline = outline_of(as_it_is(actor));
  EXPECT_EQ(outline.size(), 128);
  EXPECT_EQ(outline.tips.size(), 5U);
  EXPECT_TRUE(has_tip_near(outline, 100, 190 - 143));
  EXPECT_TRUE(has_tip_near(outline, 100 - 64, 190 - 87));
  EXPECT_TRUE(has_tip_near(outline, 100 + 64, 190 - 87));
  EXPECT_TRUE(has_tip_near(outline, 80, 190));
  EXPECT_TRUE(has_tip_near(outline, 120, 190));
  for (const OutlinePoint& point : outline.points) EXPECT_NEAR(std::hypot(point.normal_x, point.normal_y), 1, 1e-6);
}

TEST(Outline, IsEmptyForNobodyAndRefusesTooFewPoints) {
  EXPECT_TRUE(outline_of(as_it_is(Sprite{})).points.empty());
  EXPECT_THROW(outline_of(as_it_is(Sprite{}), 4), InvalidInput);
  EXPECT_TRUE(match_outlines({}, outline_of(as_it_is(drawn_actor({})))).empty());
}

TEST(Outline, MatchesItselfPointByPoint) {
  const Outline outline = outline_of(as_it_is(drawn_actor({})));
  const std::vector<double> places = match_outlines(outline, outline);
  for (int i = 0; i < outline.size(); ++i)
    EXPECT_NEAR(std::remainder(places[static_cast<std::size_t>(i)] - i, outline.size()), 0, 0.51);
}

TEST(FeatureLines, LimbsThatMoveAreMatchedWithThemselves) {
  const Sprite a = drawn_actor({.left_arm = 1.0, .right_arm = 1.0}),
               b = drawn_actor({.left_arm = 1.3, .right_arm = 0.8});
  const Outline in_a = outline_of(as_it_is(a)), in_b = outline_of(as_it_is(b));
  const std::vector<double> places = match_outlines(in_a, in_b);
  const auto pairs = matched_tips(in_a, in_b, places);
  EXPECT_EQ(pairs.size(), 5U);
  for (const auto& [tip_a, tip_b] : pairs)
    EXPECT_LT(std::hypot(in_a.point(tip_a).x - in_b.point(tip_b).x, in_a.point(tip_a).y - in_b.point(tip_b).y), 22);
}

TEST(FeatureLines, AHandWithoutCounterpartGivesNoLine) {
  const Sprite a = drawn_actor({.right_arm = 1.2}), b = drawn_actor({.right_arm = 1.2, .has_right_arm = false});
  const std::vector<FeatureLinePair> lines = outline_lines(as_it_is(a), as_it_is(b));
  EXPECT_GT(lines.size(), 12U);
  for (const FeatureLinePair& pair : lines) {
    EXPECT_LT(pair.a.qx, 150);  // the hand reaches to 164
    EXPECT_LT(std::hypot(pair.a.qx - pair.b.qx, pair.a.qy - pair.b.qy), 30);
  }
}

TEST(FeatureLines, FixedEdgesAreThoseThatStay) {
  // The right hand goes up and down: of the box only its right edge moves.
  std::vector<Sprite> sprites;
  for (int t = 0; t < 30; ++t) sprites.push_back(drawn_actor({.right_arm = 0.9 + 0.5 * std::sin(0.6 * t)}));
  const PeopleTexture texture = texture_of(sprites);
  const PlacedFrame a{10, {}}, b{20, {1, 3, 0}};
  const std::vector<FeatureLinePair> fixed = fixed_edges(texture, a, b);
  ASSERT_EQ(fixed.size(), 3U);  // left, top, bottom
  EXPECT_EQ(fixed[0].a.px, texture.silhouettes[10].box.left);
  EXPECT_EQ(fixed[0].b.px, texture.silhouettes[20].box.left + 3);
  EXPECT_EQ(fixed[2].a.py, texture.silhouettes[10].box.bottom);
  EXPECT_EQ(box_edges(texture, a, b).size(), 4U);
}

}  // namespace
}  // namespace motex
