// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/measure_silhouette.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/rng.h"

namespace motex {
namespace {

Sprite blank(int left, int top, int width, int height) {
  Sprite sprite;
  sprite.left = left, sprite.top = top, sprite.width = width, sprite.height = height;
  sprite.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return sprite;
}

void fill(Sprite& sprite, int left, int top, int width, int height, std::uint8_t alpha = 255) {
  for (int y = top; y < top + height; ++y)
    for (int x = left; x < left + width; ++x) sprite.at(x, y) = {0, 0, 0, alpha};
}

/// A body with an arm to the right, edges half transparent.
Sprite body() {
  Sprite sprite = blank(100, 40, 90, 150);
  fill(sprite, 20, 4, 30, 140);
  fill(sprite, 50, 30, 35, 9);
  fill(sprite, 19, 4, 1, 140, 90);
  return sprite;
}

/// μ_pq by its definition.
double moment(const Sprite& sprite, const Silhouette& about, int p, int q) {
  double sum = 0, area = 0;
  for (int y = 0; y < sprite.height; ++y)
    for (int x = 0; x < sprite.width; ++x) {
      const double alpha = sprite.at(x, y)[3] / 255.0;
      area += alpha;
      sum += alpha * std::pow(sprite.left + x - about.centroid_x, p) * std::pow(sprite.top + y - about.centroid_y, q);
    }
  return sum / std::pow(area, 1 + (p + q) / 2.0);
}

TEST(MeasureSilhouette, NobodyIsEmpty) {
  EXPECT_TRUE(measure_silhouette({}).empty());
  Sprite faint = blank(0, 0, 10, 10);
  fill(faint, 0, 0, 10, 10, 127);
  EXPECT_TRUE(measure_silhouette(faint).empty());
  EXPECT_EQ(measure_silhouette(faint).area, 0);
}

TEST(MeasureSilhouette, MeasuresAPersonByTheDefinition) {
  const Sprite sprite = body();
  const Silhouette found = measure_silhouette(sprite);
  EXPECT_EQ(found.box.left, 120);
  EXPECT_EQ(found.box.right, 184);
  EXPECT_EQ(found.box.top, 44);
  EXPECT_EQ(found.box.bottom, 183);
  EXPECT_NEAR(found.area, 30 * 140 + 35 * 9 + 140 * 90 / 255.0, 1e-9);
  EXPECT_NEAR(moment(sprite, found, 1, 0), 0, 1e-9);
  EXPECT_NEAR(moment(sprite, found, 0, 1), 0, 1e-9);
  EXPECT_NEAR(found.mu20, moment(sprite, found, 2, 0), 1e-9);
  EXPECT_NEAR(found.mu11, moment(sprite, found, 1, 1), 1e-9);
  EXPECT_NEAR(found.mu02, moment(sprite, found, 0, 2), 1e-9);
  EXPECT_NEAR(found.mu30, moment(sprite, found, 3, 0), 1e-9);
  EXPECT_NEAR(found.mu21, moment(sprite, found, 2, 1), 1e-9);
  EXPECT_NEAR(found.mu12, moment(sprite, found, 1, 2), 1e-9);
  EXPECT_NEAR(found.mu03, moment(sprite, found, 0, 3), 1e-9);
  EXPECT_GT(found.mu30, 0.005) << "the arm stretches to the right";
}

TEST(MeasureSilhouette, SpecksDoNotCountButAHandDoes) {
  Sprite sprite = body();
  const Silhouette plain = measure_silhouette(sprite);
  fill(sprite, 0, 148, 2, 2);
  const Silhouette specked = measure_silhouette(sprite);
  EXPECT_EQ(specked.box.left, plain.box.left);
  EXPECT_EQ(specked.box.bottom, plain.box.bottom);
  EXPECT_NEAR(specked.area, plain.area, 1e-9);
  EXPECT_NEAR(specked.mu30, plain.mu30, 1e-12);
  fill(sprite, 2, 60, 8, 8);
  const Silhouette handed = measure_silhouette(sprite);
  EXPECT_EQ(handed.box.left, 102);
  EXPECT_NEAR(handed.area, plain.area + 64, 1e-9);
}

TEST(MeasureSilhouette, TheMirrorChangesTheSignOfLeftAndRight) {
  const Sprite sprite = body();
  const Silhouette there = measure_silhouette(mirrored(sprite, 320)), told = mirrored(measure_silhouette(sprite), 320);
  EXPECT_EQ(there.box.left, told.box.left);
  EXPECT_EQ(there.box.right, told.box.right);
  EXPECT_NEAR(there.centroid_x, told.centroid_x, 1e-9);
  EXPECT_NEAR(there.mu30, told.mu30, 1e-12);
  EXPECT_NEAR(there.mu11, told.mu11, 1e-12);
  EXPECT_NEAR(there.mu21, told.mu21, 1e-12);
  EXPECT_NEAR(there.mu12, told.mu12, 1e-12);
  EXPECT_LT(there.mu30, -0.005);
}

/// Flood fill with a stack, 8 neighbours.
int flood(const Sprite& sprite, std::vector<int>& labels) {
  int found = 0;
  labels.assign(sprite.pixels.size(), -1);
  for (int start = 0; start < static_cast<int>(labels.size()); ++start) {
    std::vector<int> stack{start};
    bool is_new = false;
    while (!stack.empty()) {
      const int i = stack.back(), x = i % sprite.width, y = i / sprite.width;
      stack.pop_back();
      if (sprite.at(x, y)[3] < 128 || labels[static_cast<std::size_t>(i)] >= 0) continue;
      is_new = true;
      labels[static_cast<std::size_t>(i)] = found;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          if (x + dx >= 0 && y + dy >= 0 && x + dx < sprite.width && y + dy < sprite.height)
            stack.push_back((y + dy) * sprite.width + x + dx);
    }
    found += is_new ? 1 : 0;
  }
  return found;
}

TEST(FindParts, AgreesWithFloodingOnRandomPictures) {
  Rng rng(5);
  SilhouetteParts parts;
  for (int trial = 0; trial < 40; ++trial) {
    Sprite sprite = blank(0, 0, 7 + trial, 23);
    for (PremultipliedRgba& pixel : sprite.pixels)
      pixel[3] = rng.uniform() < 0.2 + 0.015 * trial ? std::uint8_t{200} : std::uint8_t{100};
    std::vector<int> labels;
    const int expected = flood(sprite, labels);
    find_parts(sprite, parts);
    ASSERT_EQ(static_cast<int>(parts.parts.size()), expected);
    std::int64_t area = 0;
    for (const RegionRun& run : parts.runs)
      for (int x = run.first; x <= run.last; ++x, ++area)
        ASSERT_EQ(labels[static_cast<std::size_t>(run.y * sprite.width + x)], run.region);
    EXPECT_EQ(area, parts.area);
  }
}

}  // namespace
}  // namespace motex
