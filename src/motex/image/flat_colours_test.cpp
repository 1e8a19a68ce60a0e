// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/flat_colours.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

TEST(FlatColours, RefusesWrongRequests) {
  EXPECT_THROW(palette({}, {}, 3), InvalidInput);
  const std::vector<LevelTriple> one{{1, 2, 3}};
  EXPECT_THROW(palette(one, {}, 0), InvalidInput);
  EXPECT_THROW(palette(one, std::vector<double>{1, 2}, 1), InvalidInput);
  EXPECT_THROW(flat_colours({}), InvalidInput);
}

TEST(FlatColours, PaletteFindsTheColoursThatThereAre) {
  Rng rng(3);
  const std::vector<LevelTriple> truth{{20, 30, 40}, {200, 60, 50}, {230, 230, 240}};
  std::vector<LevelTriple> noisy;
  for (int i = 0; i < 600; ++i) {
    LevelTriple colour = truth[static_cast<std::size_t>(i % 3)];
    for (float& level : colour) level += static_cast<float>(4 * rng.normal());
    noisy.push_back(colour);
  }
  const std::vector<LevelTriple> found = palette(noisy, {}, 3);
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[c][k], truth[c][k], 1.5);
}

TEST(FlatColours, NoisyHalvesBecomeTwoFlatHalves) {
  Rng rng(5);
  Plane plane(60, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) plane.at(x, y) = static_cast<float>((x < 30 ? 50 : 180) + 10 * rng.normal());
  const Image flat = flat_colours({plane}, 2, {2, 2});
  ASSERT_EQ(flat.width, 120);
  ASSERT_EQ(flat.height, 80);
  EXPECT_NEAR(flat.at(10, 40).r, 50, 12);
  EXPECT_NEAR(flat.at(110, 40).r, 180, 12);
  int between = 0;
  for (int x = 0; x < 120; ++x) between += flat.at(x, 40) != flat.at(2, 40) && flat.at(x, 40) != flat.at(118, 40);
  EXPECT_LE(between, 2);  // one anti-aliased border
}

}  // namespace
}  // namespace motex
