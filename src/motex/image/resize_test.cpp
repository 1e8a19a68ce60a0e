// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/resize.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"

namespace motex {
namespace {

Plane wave(int width, int height, double per_pixel) {
  Plane plane(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      plane.at(x, y) =
          static_cast<float>(100 + 50 * std::sin((x + 0.5) * per_pixel) + 20 * std::cos((y + 0.5) * per_pixel));
  return plane;
}

TEST(Resized, RefusesNothing) {
  EXPECT_THROW(resized(Plane(4, 4), 0, 4), InvalidInput);
  EXPECT_THROW(resized(Plane(), 4, 4), InvalidInput);
}

TEST(Resized, SameSizeIsTheSame) {
  const Plane plane = wave(17, 9, 0.8);
  EXPECT_EQ(resized(plane, 17, 9).values, plane.values);
}

TEST(Resized, KeepsConstantsAndMeans) {
  for (const int size : {1, 5, 50}) {
    const Plane out = resized(Plane(13, 7, 42), size, size);
    for (const float value : out.values) EXPECT_NEAR(value, 42, 1e-4);
  }
}

TEST(Resized, PicturesLieOnOneAnother) {
  const Plane small = wave(60, 40, 0.3), large = wave(180, 120, 0.1);
  const Plane up = resized(small, 180, 120), down = resized(large, 60, 40);
  for (int y = 12; y < 108; ++y)
    for (int x = 12; x < 168; ++x) EXPECT_NEAR(up.at(x, y), large.at(x, y), 0.6);
  for (int y = 4; y < 36; ++y)
    for (int x = 4; x < 56; ++x) EXPECT_NEAR(down.at(x, y), small.at(x, y), 0.6);
}

}  // namespace
}  // namespace motex
