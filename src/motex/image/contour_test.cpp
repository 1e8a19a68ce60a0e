// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/contour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace motex {
namespace {

/// `radius` minus the distance from (x, y): the contour at 0 is a circle.
Plane cone(int width, int height, double x, double y, double radius) {
  Plane plane(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) plane.at(u, v) = static_cast<float>(radius - std::hypot(u - x, v - y));
  return plane;
}

TEST(Contour, NothingHasNone) {
  EXPECT_TRUE(contours({}, 0).empty());
  EXPECT_TRUE(contours(Plane(5, 4, 0), 1).empty());
}

TEST(Contour, CircleLiesOnTheCircle) {
  const std::vector<Contour> found = contours(cone(40, 30, 18.3, 14.6, 9), 0);
  ASSERT_EQ(found.size(), 1U);
  for (const ContourPoint& p : found[0]) EXPECT_NEAR(std::hypot(p.x - 18.3, p.y - 14.6), 9, 0.03);
  EXPECT_NEAR(signed_area(found[0]), std::numbers::pi * 81, 1);
}

TEST(Contour, HoleRunsTheOtherWay) {
  Plane ring = cone(40, 40, 20, 20, 15);
  for (float& value : ring.values) value = std::min(value, 10 - value);  // inside: 0 … 10 from the outer circle
  const std::vector<Contour> found = contours(ring, 0);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(signed_area(found[0]) + signed_area(found[1]), std::numbers::pi * (225 - 25), 2);
  EXPECT_LT(std::min(signed_area(found[0]), signed_area(found[1])), -70);
}

TEST(Contour, ClosesAtTheBorder) {
  const std::vector<Contour> found = contours(Plane(6, 4, 3), 1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(signed_area(found[0]), 6 * 4, 1);  // whole pixels, corners cut
}

TEST(Contour, SaddleFollowsItsMiddle) {
  Plane plane(2, 2, 0);
  plane.at(0, 0) = plane.at(1, 1) = 3;
  EXPECT_EQ(contours(plane, 1).size(), 1U);  // mean 1.5 is inside: one region
  EXPECT_EQ(contours(plane, 2).size(), 2U);
}

}  // namespace
}  // namespace motex
