// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/image.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"

namespace motex {
namespace {

TEST(Image, RejectsImpossibleSizesAndRectangles) {
  EXPECT_THROW(Image(-1, 4), InvalidInput);
  EXPECT_THROW(Image(40000, 1), InvalidInput);
  EXPECT_THROW(crop(Image(4, 4), 2, 2, 3, 1), InvalidInput);
  EXPECT_THROW(crop(Image(4, 4), -1, 0, 2, 2), InvalidInput);
}

TEST(Image, BlendIsSourceOver) {
  Rgba pixel{100, 100, 100, 255};
  blend(pixel, {200, 0, 100, 255}, 0.5);
  EXPECT_EQ(pixel, (Rgba{150, 50, 100, 255}));
  blend(pixel, {1, 2, 3, 255}, 1);
  EXPECT_EQ(pixel, (Rgba{1, 2, 3, 255}));
  blend(pixel, {9, 9, 9, 255}, 0);
  EXPECT_EQ(pixel, (Rgba{1, 2, 3, 255}));
}

TEST(Image, BlendOverNothingKeepsTheColour) {
  Rgba pixel{0, 0, 0, 0};
  blend(pixel, {200, 40, 10, 255}, 0.25);
  EXPECT_EQ(pixel, (Rgba{200, 40, 10, 64}));
}

TEST(Image, MixAndAlpha) {
  EXPECT_EQ(mix({0, 0, 0, 255}, {100, 200, 50, 255}, 0.5), (Rgba{50, 100, 25, 255}));
  EXPECT_EQ(with_alpha({1, 2, 3, 200}, 0.5), (Rgba{1, 2, 3, 100}));
}

TEST(Image, CropThenPasteRestores) {
  Image image(5, 4, {10, 20, 30, 255});
  image.at(3, 2) = {255, 0, 0, 255};
  const Image part = crop(image, 2, 1, 3, 2);
  EXPECT_EQ(part.at(1, 1), (Rgba{255, 0, 0, 255}));
  Image target(5, 4, {10, 20, 30, 255});
  paste(target, part, 2, 1);
  EXPECT_EQ(target.pixels, image.pixels);
}

TEST(Image, PasteCutsWhatFallsOutside) {
  Image target(3, 3, {0, 0, 0, 255});
  paste(target, Image(4, 4, {255, 255, 255, 255}), -3, 2);
  EXPECT_EQ(target.at(0, 2).r, 255);
  EXPECT_EQ(target.at(1, 2).r, 0);
  EXPECT_EQ(target.at(0, 1).r, 0);
}

}  // namespace
}  // namespace motex
