// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/sprite.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"

namespace motex {
namespace {

Image dotted_frame() {
  Image image(8, 6);
  image.at(2, 1) = {200, 100, 50, 255};
  image.at(4, 3) = {200, 100, 50, 128};
  return image;
}

TEST(Sprite, IsTheSmallestRectangleWithEverythingInIt) {
  const Sprite sprite = sprite_of(dotted_frame());
  EXPECT_EQ(sprite.left, 2);
  EXPECT_EQ(sprite.top, 1);
  EXPECT_EQ(sprite.width, 3);
  EXPECT_EQ(sprite.height, 3);
  EXPECT_EQ(sprite.at(2, 2), (PremultipliedRgba{100, 50, 25, 128}));
  EXPECT_TRUE(sprite_of(Image(8, 6)).empty());
}

TEST(Sprite, ReturnsToAnImageUpToRounding) {
  const Image image = dotted_frame(), back = to_image(sprite_of(image), 8, 6);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    EXPECT_EQ(back.pixels[i].a, image.pixels[i].a);
    EXPECT_NEAR(back.pixels[i].r, image.pixels[i].r, 1);
  }
}

TEST(Sprite, IsPaintedOverAnOpaqueAndATransparentPicture) {
  const Sprite sprite = sprite_of(dotted_frame());
  Image opaque(8, 6, {0, 0, 200, 255}), transparent(8, 6);
  paint(opaque, sprite);
  EXPECT_EQ(opaque.at(2, 1), (Rgba{200, 100, 50, 255}));
  EXPECT_NEAR(opaque.at(4, 3).r, 100, 1);
  EXPECT_NEAR(opaque.at(4, 3).b, 25 + 100, 1);
  EXPECT_EQ(opaque.at(0, 0), (Rgba{0, 0, 200, 255}));
  paint(transparent, sprite);
  EXPECT_EQ(transparent.at(4, 3).a, 128);
  EXPECT_NEAR(transparent.at(4, 3).r, 200, 1);
}

TEST(Sprite, IsCutOffAtTheFrame) {
  Sprite sprite = sprite_of(dotted_frame());
  sprite.left = 6, sprite.top = -2;
  Image image(8, 6);
  paint(image, sprite);
  EXPECT_EQ(image.at(7, 0).a, 0);
  sprite.left = 5;
  paint(image, sprite);
  EXPECT_EQ(image.at(7, 0).a, 128);
}

TEST(Sprite, MirrorsTwiceToItself) {
  const Sprite sprite = sprite_of(dotted_frame()), there = mirrored(sprite, 8), back = mirrored(there, 8);
  EXPECT_EQ(there.left, 3);
  EXPECT_EQ(there.at(0, 2), sprite.at(2, 2));
  EXPECT_EQ(back.left, sprite.left);
  EXPECT_EQ(back.pixels, sprite.pixels);
}

TEST(Sprite, MemorySpritesRefusesFramesThatDoNotExist) {
  MemorySprites sprites({sprite_of(dotted_frame())});
  EXPECT_EQ(sprites.sprite(0)->left, 2);
  EXPECT_THROW(sprites.sprite(1), InvalidInput);
  EXPECT_THROW(sprites.sprite(-1), InvalidInput);
}

}  // namespace
}  // namespace motex
