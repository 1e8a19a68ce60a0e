// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/mask.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"

namespace motex {
namespace {

Mask scattered(int width, int height) {
  Mask mask(width, height);
  for (std::size_t i = 0; i < mask.pixels.size(); ++i) mask.pixels[i] = i * 7919 % 31 < 2 ? 1 : 0;
  return mask;
}

TEST(Mask, RefusesWrongRequests) {
  EXPECT_THROW(Mask(-1, 2), InvalidInput);
  EXPECT_THROW(dilate(Mask(3, 3), -1), InvalidInput);
  EXPECT_THROW(intersection_over_union(Mask(3, 3), Mask(3, 4)), InvalidInput);
}

TEST(Mask, DistancesAreThoseOfTryingAll) {
  for (const auto& [width, height] : {std::pair{23, 17}, {1, 9}, {9, 1}}) {
    const Mask mask = scattered(width, height);
    const Plane distance = squared_distance(mask);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        float best = INFINITY;
        for (int v = 0; v < height; ++v)
          for (int u = 0; u < width; ++u)
            if (mask.at(u, v)) best = std::min(best, static_cast<float>((u - x) * (u - x) + (v - y) * (v - y)));
        ASSERT_EQ(distance.at(x, y), best) << x << "," << y;
      }
  }
  EXPECT_TRUE(std::isinf(squared_distance(Mask(4, 3)).at(2, 2)));
}

TEST(Mask, GrowsAndShrinksByDiscs) {
  Mask point(11, 11);
  point.at(5, 5) = 1;
  EXPECT_EQ(dilate(point, 0).area(), 1);
  EXPECT_EQ(dilate(point, 1).area(), 5);
  EXPECT_EQ(dilate(point, 1.5).area(), 9);
  EXPECT_EQ(dilate(point, 3).area(), 29);
  EXPECT_EQ(erode(dilate(point, 3), 3).area(), 1);
  EXPECT_EQ(erode(Mask(5, 5, true), 2).area(), 25) << "what is outside counts as in";
}

TEST(Mask, ThresholdAndOverlap) {
  Plane ramp(4, 1);
  ramp.values = {1, 2, 3, 4};
  const Mask upper = threshold(ramp, 3), most = threshold(ramp, 2);
  EXPECT_EQ(upper.area(), 2);
  EXPECT_DOUBLE_EQ(intersection_over_union(upper, most), 2.0 / 3);
  EXPECT_DOUBLE_EQ(intersection_over_union(Mask(2, 2), Mask(2, 2)), 1);
}

}  // namespace
}  // namespace motex
