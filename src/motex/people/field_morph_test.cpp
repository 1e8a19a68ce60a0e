// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/field_morph.h"

#include <gtest/gtest.h>

#include "motex/people/align_sprites.h"
#include "motex/people/drawn_actor.h"
#include "motex/people/feature_lines.h"

namespace motex {
namespace {

std::vector<FeatureLine> side(const std::vector<FeatureLinePair>& pairs, bool of_a) {
  std::vector<FeatureLine> lines;
  for (const FeatureLinePair& pair : pairs) lines.push_back(of_a ? pair.a : pair.b);
  return lines;
}

TEST(FieldMorph, OneLineTurnsStretchesAndMovesEverything) {
  // A quarter turn to the left as seen and twice as long along the line; across it sizes stay.
  const std::vector<FeatureLine> shown{{10, 10, 20, 10}}, source{{50, 40, 50, 20}};
  const auto u = field_displacement(shown, source, 15, 13);
  EXPECT_NEAR(15 + u.x, 53, 1e-9);
  EXPECT_NEAR(13 + u.y, 30, 1e-9);
}

TEST(FieldMorph, OnALineThatLineDecides) {
  const std::vector<FeatureLine> shown{{10, 10, 40, 10}, {10, 80, 40, 80}}, source{{14, 10, 44, 10}, {10, 80, 40, 80}};
  EXPECT_NEAR(field_displacement(shown, source, 25, 10).x, 4, 0.02);
  EXPECT_NEAR(field_displacement(shown, source, 25, 80).x, 0, 0.02);
}

TEST(FieldMorph, WithoutLinesOrWithPointsForLinesNothingMoves) {
  const auto u = field_displacement({}, {}, 3, 4);
  EXPECT_EQ(u.x, 0);
  const WarpGrid grid = field_warp({{5, 5, 5, 5}}, {{9, 9, 9, 9}}, {0, 0, 31, 31});
  for (const float x : grid.x) EXPECT_EQ(x, 0);
}

TEST(FieldMorph, TheGridIsCloseToTheDenseField) {
  const Sprite a = drawn_actor({}), b = drawn_actor({.left_arm = 1.0, .right_arm = 0.3, .lean = 8, .stride = 18});
  const std::vector<FeatureLinePair> pairs = outline_lines({a, {}}, {b, {}});
  ASSERT_GT(pairs.size(), 15U);
  std::vector<FeatureLine> shown;
  for (const FeatureLinePair& pair : pairs) shown.push_back(between(pair, 0.4));
  const BoundingBox box = joined(box_of(a), box_of(b));
  const WarpGrid grid = field_warp(shown, side(pairs, true), box);
  double square = 0, worst = 0, count = 0, largest = 0;
  for (int y = box.top; y <= box.bottom; ++y) {
    for (int x = box.left; x <= box.right; ++x) {
      const auto exact = field_displacement(shown, side(pairs, true), x, y), ours = grid.at(x, y);
      const double error = std::hypot(exact.x - ours.x, exact.y - ours.y);
      square += error * error, ++count;
      worst = std::max(worst, error);
      largest = std::max(largest, std::hypot(exact.x, exact.y));
    }
  }
  EXPECT_GT(largest, 5);
  EXPECT_LT(std::sqrt(square / count), 0.15);
  EXPECT_LT(worst, 1.5);
}

TEST(FieldMorph, BeginsAsOnePictureAndEndsAsTheOther) {
  const Sprite a = drawn_actor({}), b = drawn_actor({.left_arm = 1.0, .lean = 6});
  const std::vector<FeatureLinePair> lines = outline_lines({a, {}}, {b, {}});
  EXPECT_EQ(sprite_difference(field_morph({a, {}}, {b, {}}, lines, 0, 0), a), 0);
  EXPECT_EQ(sprite_difference(field_morph({a, {}}, {b, {}}, lines, 1, 1), b), 0);
}

TEST(FieldMorph, BringsTheShapesTogetherBetterThanADissolve) {
  const Sprite a = drawn_actor({}), b = drawn_actor({.left_arm = 1.0, .right_arm = 0.3, .lean = 8});
  const std::vector<FeatureLinePair> lines = outline_lines({a, {}}, {b, {}});
  const double morph =
      sprite_difference(field_morph({a, {}}, {b, {}}, lines, 0.5, 0), field_morph({a, {}}, {b, {}}, lines, 0.5, 1));
  EXPECT_LT(morph, 0.6 * sprite_difference(a, b));
}

TEST(FieldMorph, IsTheSameForAnyNumberOfThreads) {
  const Sprite a = drawn_actor({}), b = drawn_actor({.left_arm = 1.0, .lean = 6});
  const std::vector<FeatureLinePair> lines = outline_lines({a, {}}, {b, {}});
  EXPECT_EQ(field_morph({a, {}}, {b, {}}, lines, 0.3, 0.3, {}, 1).pixels,
            field_morph({a, {}}, {b, {}}, lines, 0.3, 0.3, {}, 3).pixels);
}

}  // namespace
}  // namespace motex
