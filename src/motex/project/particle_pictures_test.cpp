// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/particle_pictures.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"

namespace motex {
namespace {

Cable straight(double x, double y, double vx, int frames) {
  Cable cable;
  for (int t = 0; t < frames; ++t) cable.core.push_back(Base{BaseKind::kGaussian, x + vx * t, y, 2, 0, {50, 0, 0}});
  return cable;
}

int dark_pixels(const Image& image, int left, int top, int right, int bottom) {
  int count = 0;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) count += image.at(x, y).g < 128 ? 1 : 0;
  return count;
}

TEST(ParticlePictures, RefusesWrongRequests) {
  EXPECT_THROW(chain_picture(TransitionMatrix(3, 1), {}), InvalidInput);
  EXPECT_THROW(picture_rows({}, 100), InvalidInput);
}

TEST(ParticlePictures, PathsAreWhereCablesWent) {
  const std::vector<Cable> cables{straight(10, 20, 1, 30), straight(10, 40, 1, 2)};
  const Image image = render(paths_picture(cables, 60, 60));
  EXPECT_GT(dark_pixels(image, 10, 18, 40, 23), 25);
  EXPECT_EQ(dark_pixels(image, 5, 30, 55, 55), 0);  // two frames are too few
}

TEST(ParticlePictures, MapsAreDarkWhereDensityIsHigh) {
  Plane density(40, 30, 0);
  for (int x = 20; x < 40; ++x)
    for (int y = 0; y < 30; ++y) density.at(x, y) = 0.001F;
  const Image image = render(density_picture(density));
  EXPECT_EQ(image.at(10, 15).r, 255);
  EXPECT_EQ(image.at(30, 15).r, 0);
}

TEST(ParticlePictures, CableRunsThroughTime) {
  Cable cable = straight(10, 20, 1, 30);
  cable.coils.push_back(straight(12, 18, 1, 30).core);
  const Image image = render(cable_picture(cable, 300, 200));
  const auto red = [&](int left, int right) {
    int count = 0;
    for (int y = 0; y < 200; ++y)
      for (int x = left; x < right; ++x)
        count += image.at(x, y).r > image.at(x, y).g + 90 && image.at(x, y).r > image.at(x, y).b + 90 ? 1 : 0;
    return count;
  };
  for (const int left : {60, 120, 180}) EXPECT_GT(red(left, left + 20), 20) << left;
}

TEST(ParticlePictures, ChainShowsTransitionsThatHappen) {
  TransitionMatrix chain(2);
  chain.add_count(0, 1, 3);
  chain.add_count(1, 0, 3);
  chain.add_count(1, 1, 1);
  Drawing cell{60, 60, {255, 255, 255, 255}, {}};
  const auto count = [](const Drawing& drawing) {
    int texts = 0;
    for (const Shape& shape : drawing.shapes) texts += std::holds_alternative<Text>(shape) ? 1 : 0;
    return texts;
  };
  EXPECT_EQ(count(chain_picture(chain, {cell, cell})), 3);  // 0→1, 1→0, 1→1
}

TEST(ParticlePictures, RowsKeepTheProportions) {
  const std::vector<PictureRow> rows{{"a", {Image(40, 20), Image(40, 20)}}, {"b", {Image(10, 20)}}};
  const Drawing drawing = picture_rows(rows, 100);
  EXPECT_DOUBLE_EQ(drawing.width, 204);
  EXPECT_DOUBLE_EQ(drawing.height, 20 + 50 + 8 + 20 + 200 + 8);
  EXPECT_EQ(base_functions_picture().shapes.size() > 10, true);
}

}  // namespace
}  // namespace motex
