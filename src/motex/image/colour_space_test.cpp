// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/colour_space.h"

#include <gtest/gtest.h>

namespace motex {
namespace {

void expect_near(const std::array<double, 3>& got, const std::array<double, 3>& wanted, double tolerance) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(got[k], wanted[k], tolerance) << "component " << k;
}

TEST(ColourSpace, PublishedCodeValues) {
  // The 75 % and 100 % bars of test cards.
  expect_near(ycbcr_from_rgb({255, 255, 255}, YcbcrMatrix::kBt601, YcbcrRange::kStudio), {235, 128, 128}, 1e-9);
  expect_near(ycbcr_from_rgb({255, 0, 0}, YcbcrMatrix::kBt601, YcbcrRange::kStudio), {81, 90, 240}, 0.6);
  expect_near(ycbcr_from_rgb({0, 0, 255}, YcbcrMatrix::kBt601, YcbcrRange::kStudio), {41, 240, 110}, 0.6);
  expect_near(ycbcr_from_rgb({255, 0, 0}, YcbcrMatrix::kBt709, YcbcrRange::kStudio), {63, 102, 240}, 0.6);
  expect_near(ycbcr_from_rgb({0, 255, 0}, YcbcrMatrix::kBt709, YcbcrRange::kStudio), {173, 42, 26}, 0.6);
  expect_near(ycbcr_from_rgb({255, 0, 0}, YcbcrMatrix::kBt601, YcbcrRange::kFull), {76.2, 85, 255.5}, 0.1);
}

TEST(ColourSpace, ThereAndBack) {
  for (const YcbcrMatrix matrix : {YcbcrMatrix::kBt601, YcbcrMatrix::kBt709})
    for (const YcbcrRange range : {YcbcrRange::kStudio, YcbcrRange::kFull})
      for (const std::array<double, 3>& rgb : {std::array<double, 3>{12, 200, 99}, {255, 3, 0}, {0, 0, 1}})
        expect_near(rgb_from_ycbcr(ycbcr_from_rgb(rgb, matrix, range), matrix, range), rgb, 1e-9);
}

TEST(ColourSpace, Srgb) {
  EXPECT_NEAR(linear_from_srgb(0.5), 0.21404, 1e-5);
  EXPECT_NEAR(linear_from_srgb(0.02), 0.02 / 12.92, 1e-12);
  for (const double value : {0.0, 0.01, 0.04, 0.3, 1.0})
    EXPECT_NEAR(srgb_from_linear(linear_from_srgb(value)), value, 1e-6);
}

}  // namespace
}  // namespace motex
