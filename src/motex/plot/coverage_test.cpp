// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/plot/coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace motex {
namespace {

/// Covered area in pixels: the alpha of black over nothing.
double painted_area(Coverage& coverage, int width, int height) {
  Image image(width, height);
  coverage.paint({{0, 0, 0, 255}, {}, {}, {}}, image);
  double sum = 0;
  for (const Rgba& p : image.pixels) sum += p.a / 255.0;
  return sum;
}

double painted_area(const std::vector<std::vector<Point>>& outlines, int width = 60, int height = 60) {
  Coverage coverage(width, height);
  for (const auto& outline : outlines) coverage.add_outline(outline);
  return painted_area(coverage, width, height);
}

TEST(Coverage, AreaOfPolygonsIsExactInEitherDirection) {
  std::vector<Point> triangle{{3.3, 4.1}, {50.7, 9.6}, {20.2, 55.9}};
  const double area = 0.5 * std::abs((50.7 - 3.3) * (55.9 - 4.1) - (20.2 - 3.3) * (9.6 - 4.1));
  EXPECT_NEAR(painted_area({triangle}), area, 0.5);
  std::reverse(triangle.begin(), triangle.end());
  EXPECT_NEAR(painted_area({triangle}), area, 0.5);
}

TEST(Coverage, PixelsAreCoveredByTheirShare) {
  Coverage coverage(4, 3);
  coverage.add_outline(rectangle({1.25, 1}, 1.5, 1));
  Image image(4, 3);
  coverage.paint({{255, 0, 0, 255}, {}, {}, {}}, image);
  EXPECT_EQ(image.at(0, 1).a, 0);
  EXPECT_NEAR(image.at(1, 1).a, 191, 1);
  EXPECT_NEAR(image.at(2, 1).a, 191, 1);
  EXPECT_EQ(image.at(3, 1).a, 0);
  EXPECT_EQ(image.at(1, 0).a, 0);
  EXPECT_EQ(image.at(1, 2).a, 0);
}

TEST(Coverage, WhatLiesOutsideIsCutOff) {
  EXPECT_NEAR(painted_area({rectangle({-20, -30}, 30, 40)}), 100, 1e-6);
  EXPECT_NEAR(painted_area({rectangle({-1e7, -1e7}, 2e7, 2e7)}), 3600, 1e-6);
  EXPECT_NEAR(painted_area({rectangle({70, 10}, 5, 5)}), 0, 1e-9);
  EXPECT_NEAR(painted_area({rectangle({NAN, 10}, 5, 5)}), 0, 1e-9);
}

TEST(Coverage, OverlapCountsOnce) {
  EXPECT_NEAR(painted_area({rectangle({10, 10}, 20, 20), rectangle({20, 10}, 20, 20)}), 600, 1e-6);
}

TEST(Coverage, PaintingForgetsTheOutlines) {
  Coverage coverage(60, 60);
  coverage.add_outline(rectangle({5, 5}, 10, 10));
  EXPECT_NEAR(painted_area(coverage, 60, 60), 100, 1e-6);
  EXPECT_NEAR(painted_area(coverage, 60, 60), 0, 1e-9);
}

TEST(Stroke, AreaIsLengthTimesWidthAndRoundEnds) {
  const std::vector<Point> line{{10, 20}, {45, 37}};
  EXPECT_NEAR(painted_area(stroke_outlines(line, 6)), std::hypot(35, 17) * 6 + M_PI * 9, 1.5);
  EXPECT_NEAR(painted_area(stroke_outlines(std::vector<Point>{{30, 30}}, 20)), M_PI * 100, 4);
}

TEST(Stroke, SmoothCurvesAreOneOutlineAndSharpTurnsStayClosed) {
  std::vector<Point> arc;
  for (int i = 0; i <= 40; ++i) arc.push_back({30 + 20 * std::cos(i * 0.05), 30 + 20 * std::sin(i * 0.05)});
  const auto outlines = stroke_outlines(arc, 4);
  EXPECT_EQ(outlines.size(), 1U);
  EXPECT_NEAR(painted_area(outlines), 2 * 20 * 4 + M_PI * 4, 1.5);
  const std::vector<Point> hairpin{{10, 30}, {50, 30}, {10, 30.5}};
  EXPECT_EQ(stroke_outlines(hairpin, 4).size(), 2U);
}

TEST(Stroke, DashesCoverHalf) {
  double drawn = 0;
  for (const auto& piece : dashes(std::vector<Point>{{0, 0}, {30, 0}, {30, 50}}, 4))
    for (std::size_t i = 1; i < piece.size(); ++i)
      drawn += std::hypot(piece[i].x - piece[i - 1].x, piece[i].y - piece[i - 1].y);
  EXPECT_NEAR(drawn, 40, 4);
}

TEST(Stroke, NothingYieldsNothing) {
  EXPECT_TRUE(stroke_outlines({}, 3).empty());
  EXPECT_TRUE(dashes({}, 3).empty());
}

}  // namespace
}  // namespace motex
