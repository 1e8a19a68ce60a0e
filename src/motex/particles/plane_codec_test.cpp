// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/plane_codec.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"

namespace motex {
namespace {

Planes hills(int width, int height, int num_planes) {
  Planes planes;
  for (int k = 0; k < num_planes; ++k) {
    Plane plane(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        plane.at(x, y) = static_cast<float>(120 + 60 * std::sin(0.1 * x + k) * std::cos(0.13 * y) + (x > 20 ? 30 : 0));
    planes.push_back(plane);
  }
  return planes;
}

Planes again(const Planes& planes, double step, std::size_t* size = nullptr) {
  RangeWriter writer;
  write_planes(writer, planes, step);
  const std::string bytes = writer.finish();
  if (size != nullptr) *size = bytes.size();
  RangeReader reader(bytes, "x");
  return read_planes(reader, planes[0].width, planes[0].height, static_cast<int>(planes.size()), step);
}

TEST(PlaneCodec, ErrorIsThatOfTheStepAndNoBytesAreWasted) {
  for (const int num_planes : {1, 3}) {
    const Planes planes = hills(83, 45, num_planes);
    std::size_t fine = 0, coarse = 0;
    const double good = psnr(planes, again(planes, 2, &fine)), poor = psnr(planes, again(planes, 16, &coarse));
    EXPECT_GT(good, 20 * std::log10(255 / (2 / std::sqrt(12.0))) - 1.5);
    EXPECT_GT(poor, 20 * std::log10(255 / (16 / std::sqrt(12.0))) - 1.5);
    EXPECT_LT(coarse, fine / 2);
    EXPECT_LT(static_cast<double>(fine), 0.35 * 83 * 45 * num_planes);
  }
}

TEST(PlaneCodec, WhatWasReadGivesTheSameAgain) {
  const Planes once = again(hills(40, 24, 3), 8), twice = again(once, 8);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < once[k].values.size(); ++i) ASSERT_NEAR(once[k].values[i], twice[k].values[i], 1e-3);
}

TEST(PlaneCodec, AnEvenPictureCostsNearlyNothing) {
  std::size_t size = 0;
  const Planes even{Plane(320, 240, 77)};
  EXPECT_GT(psnr(even, again(even, 8, &size)), 40);
  EXPECT_LT(size, 60U);
}

TEST(PlaneCodec, CutOffBytesAreSaid) {
  RangeWriter writer;
  write_planes(writer, hills(64, 64, 1), 1);
  const std::string bytes = writer.finish();
  RangeReader reader(std::string_view(bytes).substr(0, bytes.size() / 2), "x");
  EXPECT_THROW(read_planes(reader, 64, 64, 1, 1), ParseError);
}

}  // namespace
}  // namespace motex
