// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/mask_regions.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "motex/core/rng.h"
#include "motex/people/fill_plane.h"

namespace motex {
namespace {

Mask mask_of(const std::vector<std::string>& rows) {
  Mask mask(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()));
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      mask.at(x, y) = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#' ? 1 : 0;
  return mask;
}

int count(const MaskRegions& found, bool value) {
  int sum = 0;
  for (const MaskRegion& region : found.regions) sum += region.value == value ? 1 : 0;
  return sum;
}

TEST(MaskRegions, CornersJoinWhatIsInAndPartWhatIsNot) {
  MaskRegions found;
  find_regions(mask_of({"#..", ".#.", "..#"}), found);
  EXPECT_EQ(count(found, true), 1);
  EXPECT_EQ(count(found, false), 2);
  find_regions(mask_of({"..#", ".#.", "#.."}), found);
  EXPECT_EQ(count(found, true), 1);
  EXPECT_EQ(count(found, false), 2);
}

TEST(MaskRegions, AHoleIsNotAtTheBorder) {
  MaskRegions found;
  find_regions(mask_of({"......", ".####.", ".#..#.", ".####.", "......"}), found);
  ASSERT_EQ(found.regions.size(), 3U);
  EXPECT_TRUE(found.regions[0].at_border);
  EXPECT_EQ(found.regions[1].area, 10);
  EXPECT_FALSE(found.regions[2].at_border);
  EXPECT_EQ(found.regions[2].area, 2);
}

/// Labels by flooding from every pixel, for comparison.
int flooded(const Mask& mask, bool value) {
  std::vector<int> seen(mask.pixels.size());
  int num = 0;
  for (int start = 0; start < static_cast<int>(seen.size()); ++start) {
    if (seen[static_cast<std::size_t>(start)] != 0 || (mask.pixels[static_cast<std::size_t>(start)] != 0) != value)
      continue;
    ++num;
    std::vector<int> waiting{start};
    while (!waiting.empty()) {
      const int at = waiting.back(), x = at % mask.width, y = at / mask.width;
      waiting.pop_back();
      if (seen[static_cast<std::size_t>(at)] != 0) continue;
      seen[static_cast<std::size_t>(at)] = 1;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int u = x + dx, v = y + dy;
          if ((!value && dx != 0 && dy != 0) || u < 0 || v < 0 || u >= mask.width || v >= mask.height) continue;
          if (mask.at(u, v) == value) waiting.push_back(v * mask.width + u);
        }
      }
    }
  }
  return num;
}

TEST(MaskRegions, AreThoseOfFlooding) {
  Rng rng(4);
  MaskRegions found;
  for (int round = 0; round < 30; ++round) {
    Mask mask(1 + static_cast<int>(rng.below(40)), 1 + static_cast<int>(rng.below(20)));
    const double share = rng.uniform(0.2, 0.8);
    for (auto& pixel : mask.pixels) pixel = rng.uniform() < share ? 1 : 0;
    find_regions(mask, found);
    EXPECT_EQ(count(found, true), flooded(mask, true));
    EXPECT_EQ(count(found, false), flooded(mask, false));
  }
}

TEST(FillUnknown, ContinuesWhatIsKnown) {
  Plane plane(40, 30);
  Mask known(40, 30, true);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) plane.at(x, y) = static_cast<float>(x + 2 * y);
  for (int y = 10; y < 20; ++y)
    for (int x = 12; x < 24; ++x) known.at(x, y) = 0, plane.at(x, y) = -500;
  fill_unknown(plane, known);
  EXPECT_EQ(plane.at(3, 4), 11);
  for (int y = 10; y < 20; ++y)
    for (int x = 12; x < 24; ++x) EXPECT_NEAR(plane.at(x, y), x + 2 * y, 10);
  fill_unknown(plane, Mask(40, 30));
  EXPECT_EQ(plane.at(7, 7), 0);
}

}  // namespace
}  // namespace motex
