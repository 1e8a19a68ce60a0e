// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/planes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/image/pyramid.h"

namespace motex {
namespace {

Image coloured() {
  Image image(5, 4, {0, 0, 0, 255});
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x)
      image.at(x, y) = {static_cast<std::uint8_t>(50 * x), static_cast<std::uint8_t>(60 * y), 7, 255};
  return image;
}

TEST(Planes, RefusesWrongShapes) {
  EXPECT_THROW(Plane(-1, 3), InvalidInput);
  EXPECT_THROW(Plane(40000, 3), InvalidInput);
  EXPECT_THROW(to_planes(coloured(), 2), InvalidInput);
  EXPECT_THROW(to_image(Planes{}), InvalidInput);
  EXPECT_THROW(to_image(Planes{Plane(2, 2), Plane(2, 3), Plane(2, 2)}), InvalidInput);
  EXPECT_THROW(psnr(Plane(2, 2), Plane(3, 2)), InvalidInput);
}

TEST(Planes, AndBackAgain) {
  Image image = coloured();
  EXPECT_EQ(to_planes(image).size(), 3U);
  EXPECT_EQ(to_image(to_planes(image)).pixels, image.pixels);
  image.at(1, 1).a = 9;
  EXPECT_EQ(to_planes(image).size(), 4U);
  EXPECT_EQ(to_image(to_planes(image)).pixels, image.pixels);
  const Image grey(3, 2, {8, 8, 8, 255});
  EXPECT_EQ(to_planes(grey).size(), 1U);
  EXPECT_EQ(to_image(to_planes(grey)).pixels, grey.pixels);
}

TEST(Planes, LevelsAreRoundedAndCutOff) {
  Plane plane(4, 1);
  plane.values = {-20, 99.6F, 300, 99.4F};
  const Image image = to_image(plane);
  EXPECT_EQ(image.at(0, 0).r, 0);
  EXPECT_EQ(image.at(1, 0).r, 100);
  EXPECT_EQ(image.at(2, 0).g, 255);
  EXPECT_EQ(image.at(3, 0).b, 99);
}

TEST(Planes, PsnrIsItsFormula) {
  EXPECT_TRUE(std::isinf(psnr(Plane(3, 3, 5), Plane(3, 3, 5))));
  EXPECT_NEAR(psnr(Plane(3, 3, 5), Plane(3, 3, 15)), 20 * std::log10(25.5), 1e-9);
  EXPECT_NEAR(luma(Image(1, 1, {255, 0, 0, 255})).values[0], 76.245, 1e-3);
}

TEST(Pyramid, HalvingKeepsConstantsAndRamps) {
  Plane ramp(21, 14);
  for (int y = 0; y < 14; ++y)
    for (int x = 0; x < 21; ++x) ramp.at(x, y) = static_cast<float>(3 * x + 2 * y);
  const Plane half = halve(ramp);
  ASSERT_EQ(half.width, 11);
  ASSERT_EQ(half.height, 7);
  for (int y = 1; y < 6; ++y)
    for (int x = 1; x < 10; ++x) EXPECT_NEAR(half.at(x, y), 6 * x + 4 * y, 1e-4) << "pixel (x, y) is the old (2x, 2y)";
  for (const float value : halve(Plane(9, 9, 4)).values) EXPECT_NEAR(value, 4, 1e-6);
  EXPECT_EQ(gaussian_pyramid(Plane(1, 1, 3), 4).back().values, std::vector<float>{3});
}

TEST(Pyramid, UpdatesAreLikeAnew) {
  Plane plane(30, 20);
  for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = static_cast<float>(i * 7919 % 255);
  Plane half = halve(plane);
  for (int y = 5; y <= 9; ++y)
    for (int x = 11; x <= 14; ++x) plane.at(x, y) += 50;
  update_half(plane, half, (11 - 2) / 2, (5 - 2) / 2, (14 + 3) / 2, (9 + 3) / 2);
  EXPECT_EQ(half.values, halve(plane).values);
}

TEST(Pyramid, BlurSpreadsAPointToAGaussian) {
  Plane point(41, 41);
  point.at(20, 20) = 1000;
  const Plane blurred = gaussian_blur(point, 2.5);
  double sum = 0, spread = 0;
  for (int y = 0; y < 41; ++y)
    for (int x = 0; x < 41; ++x) {
      sum += blurred.at(x, y);
      spread += blurred.at(x, y) * (x - 20) * (x - 20);
    }
  EXPECT_NEAR(sum, 1000, 0.1);
  EXPECT_NEAR(std::sqrt(spread / sum), 2.5, 0.1);
  EXPECT_EQ(gaussian_blur(point, 0).values, point.values);
  EXPECT_THROW(gaussian_blur(point, -1), InvalidInput);
}

TEST(Planes, SubtractsPlanesOfOneSize) {
  const Plane a(3, 2, 7), b(3, 2, 4);
  EXPECT_EQ(minus(a, b).values, std::vector<float>(6, 3));
  EXPECT_EQ(minus(Planes{a, b}, Planes{b, b})[1].values, std::vector<float>(6, 0));
  EXPECT_DOUBLE_EQ(sum_of_squares(a), 6 * 49);
  EXPECT_THROW(minus(a, Plane(2, 3)), InvalidInput);
  EXPECT_THROW(minus(Planes{a}, Planes{a, b}), InvalidInput);
}

TEST(Planes, APointIsInsideOnAPixel) {
  EXPECT_TRUE(is_inside(-0.5, -0.5, 4, 3));
  EXPECT_TRUE(is_inside(3.49, 2.49, 4, 3));
  EXPECT_FALSE(is_inside(3.5, 0, 4, 3));
  EXPECT_FALSE(is_inside(0, 2.5, 4, 3));
  EXPECT_FALSE(is_inside(-0.51, 0, 4, 3));
}

}  // namespace
}  // namespace motex
