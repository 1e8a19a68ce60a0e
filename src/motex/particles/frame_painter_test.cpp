// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/frame_painter.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/particles/cable.h"

namespace motex {
namespace {

Image random_image(int width, int height, std::uint64_t seed) {
  Rng rng(seed);
  Image image(width, height);
  const auto level = [&rng] { return static_cast<std::uint8_t>(rng.below(256)); };
  for (Rgba& p : image.pixels) {
    p.r = level();
    p.g = level();
    p.b = level();
    p.a = 255;
  }
  return image;
}

TEST(MakeLayer, OverItsBackgroundGivesThePictureExactly) {
  const Image background = random_image(97, 61, 1);
  Image picture = random_image(97, 61, 2), layer;
  for (std::size_t i = 0; i < picture.pixels.size(); i += 3) picture.pixels[i] = background.pixels[i];
  for (std::size_t i = 1; i < picture.pixels.size(); i += 3) {  // small differences
    picture.pixels[i] = background.pixels[i];
    picture.pixels[i].g = static_cast<std::uint8_t>(picture.pixels[i].g ^ 1U);
  }
  make_layer(picture, background, layer);
  Image composed = background;
  paste(composed, layer, 0, 0);
  std::size_t num_different = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    num_different += composed.pixels[i] == picture.pixels[i] ? 0 : 1;
  EXPECT_EQ(num_different, 0U);
  for (std::size_t i = 0; i < picture.pixels.size(); i += 3) ASSERT_EQ(layer.pixels[i].a, 0);
}

TEST(MakeLayer, BrightBecomesWhiteAndDarkBlack) {
  const Image background(16, 16, {100, 100, 100, 255});
  Image picture = background, layer;
  picture.at(4, 4) = {178, 178, 178, 255};
  picture.at(9, 9) = {0, 0, 0, 255};
  make_layer(picture, background, layer);
  EXPECT_EQ(layer.at(4, 4).a, 129) << "half of the way to white";
  EXPECT_GE(layer.at(4, 4).r, 254);
  EXPECT_EQ(layer.at(9, 9), (Rgba{0, 0, 0, 255}));
  EXPECT_EQ(layer.at(0, 0).a, 0);
  EXPECT_THROW(make_layer(picture, Image(3, 3), layer), InvalidInput);
}

TEST(PhotoPainter, LayerOverTheBackgroundIsThePicture) {
  Rng rng(5);
  Planes background(3, Plane(80, 60));
  for (Plane& plane : background)
    for (float& value : plane.values) value = static_cast<float>(rng.uniform(0, 255));
  MovetonFrame frame;
  for (int k = 0; k < 60; ++k) {
    Base base;
    base.kind = BaseKind::kGaussian;
    base.x = rng.uniform(0, 80);
    base.y = rng.uniform(0, 60);
    base.scale = rng.uniform(0.8, 3);
    for (float& c : base.coefficients) c = static_cast<float>(rng.uniform(-500, 500));
    frame.bases.push_back(base);
  }
  PhotoPainter painter(background, 1);
  Image picture, layer;
  painter.paint(frame, picture, layer);
  Image composed = to_image(background);
  EXPECT_LT(psnr(composed, picture), 40) << "something was drawn";
  paste(composed, layer, 0, 0);
  EXPECT_GT(psnr(composed, picture), 1000) << "infinite: every pixel equal";
}

TEST(PhotoPainter, NoPixelGetsMoreLightThanElementsHave) {
  Base bright{BaseKind::kGaussian, 20, 20, 3, 0, {}}, dark{BaseKind::kGaussian, 50, 20, 3, 0, {}};
  for (float& c : bright.coefficients) c = static_cast<float>(coefficient_of_peak(bright, 90));
  for (float& c : dark.coefficients) c = static_cast<float>(coefficient_of_peak(dark, -90));
  MovetonFrame frame;
  frame.bases = {bright, dark};
  Image picture, layer;
  PhotoPainter(Planes(3, Plane(70, 40, 100)), 1, 3, {-200, 5}).paint(frame, picture, layer);
  EXPECT_EQ(picture.at(20, 20).g, 105);
  EXPECT_NEAR(picture.at(50, 20).g, 10, 2);
}

}  // namespace
}  // namespace motex
