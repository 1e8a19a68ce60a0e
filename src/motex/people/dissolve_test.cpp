// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/dissolve.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr int kSize = 60;

/// A grey square with a dark one of 14 pixels at that column.
Sprite face(int eye_at) {
  Sprite sprite{3, -4, kSize, kSize, std::vector<PremultipliedRgba>(std::size_t{kSize} * kSize, {150, 150, 150, 255})};
  for (int y = 20; y < 34; ++y)
    for (int x = eye_at; x < eye_at + 14; ++x) sprite.at(x, y) = {20, 20, 20, 255};
  return sprite;
}

TEST(Dissolve, AlikePicturesAreMixedByTheWeight) {
  Sprite a = face(8), b = a;
  for (PremultipliedRgba& pixel : b.pixels)
    for (std::size_t k = 0; k < 3; ++k) pixel[k] = static_cast<std::uint8_t>(pixel[k] + 5);
  EXPECT_EQ(dissolve_where_alike(a, b, 0).pixels, a.pixels);
  EXPECT_EQ(dissolve_where_alike(a, b, 1).pixels, b.pixels);
  EXPECT_EQ(dissolve_where_alike(a, b, 0.4).at(1, 1)[0], 152);
  EXPECT_EQ(dissolve_where_alike(a, b, 0.4).at(12, 25)[0], 22);
}

TEST(Dissolve, AnEyeIsNotSeenTwiceForLong) {
  const Sprite a = face(8), b = face(38);
  const Sprite early = dissolve_where_alike(a, b, 0.25), middle = dissolve_where_alike(a, b, 0.5);
  EXPECT_EQ(early.at(14, 27)[0], 20);   // a's eye
  EXPECT_EQ(early.at(44, 27)[0], 150);  // not yet b's
  EXPECT_EQ(middle.at(14, 27)[0], 85);
  EXPECT_EQ(dissolve_where_alike(a, b, 0.75).at(14, 27)[0], 150);
}

TEST(Dissolve, OutlinesChangeByTheWeightAlone) {
  const Sprite a = face(8);
  Sprite b = face(38);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < 6; ++x) b.at(x, y) = {};
  const Sprite mixed = dissolve_where_alike(a, b, 0.2);
  for (int y = 0; y < kSize; ++y) EXPECT_EQ(mixed.at(3, y)[3], 204);
}

TEST(Dissolve, PicturesOfUnlikeRectanglesAreRefused) {
  Sprite moved = face(8);
  ++moved.left;
  EXPECT_THROW(dissolve_where_alike(face(8), moved, 0.5), InvalidInput);
}

}  // namespace
}  // namespace motex
