// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/clean_plate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

constexpr int kWidth = 120, kHeight = 90;

std::uint8_t noisy(double level, Rng& rng) {
  return static_cast<std::uint8_t>(std::clamp(level + 2 * rng.normal(), 0.0, 255.0));
}

/// Colour of an empty place: a screen that gets darker to the right, or a chequered wall.
Rgba scene(int x, int y, bool chequered) {
  if (chequered)
    return ((x / 10 + y / 10) % 2 == 0) ? Rgba{200, 60, 40, 255}
                                        : Rgba{static_cast<std::uint8_t>(2 * x), 120, 200, 255};
  const double light = 1 - 0.3 * x / kWidth;
  return {static_cast<std::uint8_t>(50 * light), static_cast<std::uint8_t>(180 * light),
          static_cast<std::uint8_t>(60 * light), 255};
}

/// A red block walks to and fro; `shift`: the camera's step a frame; a grey logo stands at the upper left.
std::vector<Image> footage(int count, bool chequered, int shift = 0, bool logo = false, int sway = 25) {
  std::vector<Image> frames;
  for (int t = 0; t < count; ++t) {
    Rng rng(static_cast<std::uint64_t>(t) + 5);
    Image frame(kWidth, kHeight);
    const int left = chequered ? 5 + 13 * t % 85 : 45 + static_cast<int>(sway * std::sin(0.7 * t));
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool actor = x >= left && x < left + 24 && y >= 25 && y < 85;
        const bool is_logo = logo && x >= 5 && x < 20 && y >= 5 && y < 12;
        const Rgba p = actor     ? Rgba{170, 30, 60, 255}
                       : is_logo ? Rgba{128, 128, 128, 255}
                                 : scene((x + shift * t) % kWidth, y, chequered);
        frame.at(x, y) = {noisy(p.r, rng), noisy(p.g, rng), noisy(p.b, rng), 255};
      }
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

double mean_error(const CleanPlate& plate, bool chequered) {
  double sum = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Rgba a = plate.picture.at(x, y), b = scene(x, y, chequered);
      sum += std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
    }
  }
  return sum / (3 * kWidth * kHeight);
}

TEST(CleanPlate, RefusesWhatItCannotUse) {
  EXPECT_THROW(estimate_clean_plate({}), InvalidInput);
  const std::vector<Image> two_sizes{Image(20, 20), Image(21, 20)};
  EXPECT_THROW(estimate_clean_plate(two_sizes), InvalidInput);
  const std::vector<Image> few = footage(3, true);
  EXPECT_THROW(estimate_clean_plate(few), InvalidInput);
  EXPECT_THROW(clean_plate_of(Image(20, 20, {0, 0, 0, 255}), few), InvalidInput);
  EXPECT_THROW(estimate_clean_plate(footage(12, true, 7)), InvalidInput) << "the camera moves";
  CleanPlateOptions options;
  options.screen = BackgroundChoice::kScreen;
  EXPECT_THROW(estimate_clean_plate(footage(12, true), options), InvalidInput) << "no screen";
}

TEST(CleanPlate, FindsAnUnevenScreenAndItsNoise) {
  const CleanPlate plate = estimate_clean_plate(footage(24, false));
  EXPECT_EQ(plate.kind, ScreenKind::kGreen);
  EXPECT_LT(mean_error(plate, false), 1.0);
  EXPECT_NEAR(plate.noise.at(5, 40), 2, 0.7);
}

TEST(CleanPlate, FillsInWhatIsNeverSeen) {
  const CleanPlate plate = estimate_clean_plate(footage(24, false, 0, false, 6));
  EXPECT_LT(plate.seen_share, 0.95);
  EXPECT_LT(mean_error(plate, false), 2.5);
}

TEST(CleanPlate, FindsANaturalScene) {
  const CleanPlate plate = estimate_clean_plate(footage(32, true));
  EXPECT_EQ(plate.kind, ScreenKind::kNatural);
  EXPECT_LT(mean_error(plate, true), 1.5);
}

TEST(CleanPlate, ThingsThatStandStillBelongToTheScene) {
  const CleanPlate plate = estimate_clean_plate(footage(24, false, 0, true));
  EXPECT_NEAR(plate.picture.at(12, 8).r, 128, 3);
  EXPECT_NEAR(plate.picture.at(12, 8).g, 128, 3);
  EXPECT_GT(plate.picture.at(57, 50).g, 120) << "the actor, never away from here, does not";
}

}  // namespace
}  // namespace motex
