// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/key.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/image/flat_colours.h"

namespace motex {
namespace {

constexpr int kWidth = 161, kHeight = 121;  // odd on purpose

/// A disc and a bar of two colours before an unevenly lit screen, with noise; everything known.
struct Stage {
  Rgba screen{40, 180, 60, 255};
  Rgba disc{180, 60, 50, 255};
  double noise = 2, spill = 0, hole = 6;

  LevelTriple background(int x, int y) const {
    const double u = x / 80.0 - 1, v = y / 60.0 - 1, light = 1 - 0.2 * u * u - 0.2 * v * v;
    return {static_cast<float>(light * screen.r), static_cast<float>(light * screen.g),
            static_cast<float>(light * screen.b)};
  }
  static double centre(int t) { return 80 + 30 * std::sin(0.35 * t); }
  /// Share of the pixel that the disc (radius 22, with a hole of radius 6) covers.
  static double alpha(int x, int y, int t, double hole = 6) {
    const double distance = std::hypot(x - centre(t), y - 60.0);
    return std::clamp(22.5 - distance, 0.0, 1.0) * std::clamp(distance - hole, 0.0, 1.0);
  }
  Image frame(int t) const {
    Rng rng(static_cast<std::uint64_t>(t) + 1);
    Image image(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const LevelTriple back = background(x, y);
        const double a = alpha(x, y, t, hole);
        const auto mixed = [&](double front, double behind) {
          front += spill * (behind - front);
          return static_cast<std::uint8_t>(std::clamp(a * front + (1 - a) * behind + noise * rng.normal(), 0.0, 255.0));
        };
        image.at(x, y) = {mixed(disc.r, back[0]), mixed(disc.g, back[1]), mixed(disc.b, back[2]), 255};
      }
    }
    return image;
  }
  std::vector<Image> frames(int count) const {
    std::vector<Image> out;
    for (int t = 0; t < count; ++t) out.push_back(frame(t));
    return out;
  }
};

/// Mean absolute error of alpha, 0 … 1.
double matte_error(const Sprite& sprite, int t) {
  const Image image = to_image(sprite, kWidth, kHeight);
  double sum = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) sum += std::abs(image.at(x, y).a / 255.0 - Stage::alpha(x, y, t));
  return sum / (kWidth * kHeight);
}

TEST(Keyer, RefusesFramesAndMasksOfAnotherSize) {
  const std::vector<Image> frames = Stage().frames(8);
  EXPECT_THROW(Keyer(estimate_clean_plate(frames), {}, Mask(3, 3)), InvalidInput);
  Keyer keyer(estimate_clean_plate(frames));
  EXPECT_THROW(keyer.key(Image(20, 20)), InvalidInput);
  KeyOptions options;
  options.spill = 2;
  EXPECT_THROW(Keyer(estimate_clean_plate(frames), options), InvalidInput);
}

TEST(Keyer, FindsSoftMattesOnGreenBlueAndPlainScreens) {
  for (const Rgba screen : {Rgba{40, 180, 60, 255}, Rgba{40, 70, 190, 255}, Rgba{200, 190, 40, 255}}) {
    Stage stage;
    stage.screen = screen;
    const std::vector<Image> frames = stage.frames(24);
    Keyer keyer(estimate_clean_plate(frames));
    for (const int t : {0, 7, 23}) {
      const Sprite sprite = keyer.key(frames[static_cast<std::size_t>(t)]);
      EXPECT_LT(matte_error(sprite, t), 0.0012);
    }
  }
}

/// Mean of 5 × 5 pixels, as a lens or a codec softens; a margin stays as it is.
Image blurred(const Image& image) {
  Image out = image;
  for (int y = 2; y < image.height - 2; ++y)
    for (int x = 2; x < image.width - 2; ++x) {
      std::array<int, 3> sum{};
      for (int k = 0; k < 25; ++k) {
        const Rgba& pixel = image.at(x + k % 5 - 2, y + k / 5 - 2);
        sum[0] += pixel.r, sum[1] += pixel.g, sum[2] += pixel.b;
      }
      const auto mean = [](int total) { return static_cast<std::uint8_t>((total + 12) / 25); };
      out.at(x, y) = {mean(sum[0]), mean(sum[1]), mean(sum[2]), 255};
    }
  return out;
}

TEST(Keyer, ABlurredSmallHoleStaysOpen) {
  Stage stage;
  stage.hole = 4;
  std::vector<Image> frames;
  for (const Image& frame : stage.frames(24)) frames.push_back(blurred(frame));
  Keyer keyer(estimate_clean_plate(frames));
  for (int t = 0; t < 24; ++t) {
    const Image keyed = to_image(keyer.key(frames[static_cast<std::size_t>(t)]), kWidth, kHeight);
    const int x = static_cast<int>(std::lround(Stage::centre(t)));
    EXPECT_LT(keyed.at(x, 60).a, 60) << t;
    EXPECT_GT(keyed.at(x + 12, 60).a, 250) << t;
  }
}

TEST(Keyer, GivesTheActorsOwnColours) {
  const std::vector<Image> frames = Stage().frames(24);
  Keyer keyer(estimate_clean_plate(frames));
  const Sprite sprite = keyer.key(frames[5]);
  double red = 0, green = 0, alpha = 0;
  for (const auto& [r, g, b, a] : sprite.pixels) {
    EXPECT_LE(std::max({r, g, b}), a);
    if (a > 0 && a < 255) red += r, green += g, alpha += a / 255.0;
  }
  EXPECT_NEAR(red / alpha, 180, 8);
  EXPECT_NEAR(green / alpha, 60, 8);
}

TEST(Keyer, AnEmptySceneIsAnEmptySprite) {
  const Stage stage;
  Keyer keyer(estimate_clean_plate(stage.frames(16)));
  Image empty(kWidth, kHeight);
  Rng rng(9);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const LevelTriple b = stage.background(x, y);
      const auto noisy = [&](float v) { return static_cast<std::uint8_t>(v + 2 * rng.normal()); };
      empty.at(x, y) = {noisy(b[0]), noisy(b[1]), noisy(b[2]), 255};
    }
  }
  EXPECT_TRUE(keyer.key(empty).empty());
}

TEST(Keyer, LeavesOutGarbage) {
  const std::vector<Image> frames = Stage().frames(16);
  Mask garbage(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) garbage.at(x, y) = y < 60 ? 1 : 0;
  Keyer keyer(estimate_clean_plate(frames), {}, garbage);
  EXPECT_GE(keyer.key(frames[3]).top, 60);
}

TEST(Keyer, TheSameFrameGivesTheSameSpriteInAnyOrder) {
  const std::vector<Image> frames = Stage().frames(12);
  Keyer keyer(estimate_clean_plate(frames)), other = keyer;
  const Sprite first = keyer.key(frames[4]);
  other.key(frames[9]);
  const Sprite second = other.key(frames[4]);
  EXPECT_EQ(first.left, second.left);
  EXPECT_EQ(first.pixels, second.pixels);
}

}  // namespace
}  // namespace motex
