// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/chroma_shift.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "motex/image/planes.h"
#include "motex/people/key.h"

namespace motex {
namespace {

constexpr int kWidth = 120, kHeight = 96, kLeft = 40, kRight = 80;
constexpr Rgba kGreen{40, 180, 60, 255};

/// A block before a green screen, its outline a quarter of a pixel further in each frame.
Image scene(Rgba front, int frame) {
  Image image(kWidth, kHeight, kGreen);
  const double left = kLeft + 0.25 * frame, right = kRight + 0.25 * frame;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double alpha = std::clamp(std::min(x + 0.5 - left, right - x + 0.5), 0.0, 1.0);
      const auto mix = [&](int f, int b) {
        return static_cast<std::uint8_t>(std::lround(alpha * f + (1 - alpha) * b));
      };
      image.at(x, y) = {mix(front.r, kGreen.r), mix(front.g, kGreen.g), mix(front.b, kGreen.b), 255};
    }
  return image;
}

/// Light as it is; colours the mean of weights · those of the pixels from one to the left to one to the right.
Image with_coarse_colours(const Image& image, const std::array<double, 3>& weights) {
  Image out = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 1; x + 1 < image.width; ++x) {
      std::array<double, 3> sum{};
      for (int k = -1; k <= 1; ++k) {
        const Rgba& p = image.at(x + k, y);
        const double light = luma_of<double>(p.r, p.g, p.b), weight = weights[static_cast<std::size_t>(k + 1)];
        sum[0] += weight * (p.r - light), sum[1] += weight * (p.g - light), sum[2] += weight * (p.b - light);
      }
      const Rgba& p = image.at(x, y);
      const double light = luma_of<double>(p.r, p.g, p.b);
      const auto level = [&](double v) {
        return static_cast<std::uint8_t>(std::lround(std::clamp(v + light, 0.0, 255.0)));
      };
      out.at(x, y) = {level(sum[0]), level(sum[1]), level(sum[2]), 255};
    }
  return out;
}

std::vector<Image> film(Rgba front, const std::array<double, 3>& weights) {
  std::vector<Image> frames;
  for (int k = 0; k < 16; ++k) frames.push_back(with_coarse_colours(scene(front, k), weights));
  return frames;
}

constexpr Rgba kShirt{200, 90, 70, 255}, kGrey{200, 200, 200, 255};
constexpr std::array<double, 3> kInPlace{0.25, 0.5, 0.25}, kFromLeft{0.5, 0.5, 0}, kFromRight{0, 0.5, 0.5};

TEST(ChromaShift, IsSeenAtColouredOutlines) {
  const Image empty(kWidth, kHeight, kGreen);
  EXPECT_EQ(measure_chroma_shift(empty, film(kShirt, kInPlace)), 0.0F);
  EXPECT_EQ(measure_chroma_shift(empty, film(kShirt, kFromLeft)), 0.5F);  // what lay left is shown further right
  EXPECT_EQ(measure_chroma_shift(empty, film(kShirt, kFromRight)), -0.5F);
}

TEST(ChromaShift, TooFewOutlinesAndGreyOnesSayNothing) {
  const Image empty(kWidth, kHeight, kGreen);
  EXPECT_EQ(measure_chroma_shift(empty, {}), 0.0F);
  EXPECT_EQ(measure_chroma_shift(empty, std::vector<Image>{film(kShirt, kFromLeft)[0]}), 0.0F);
  EXPECT_EQ(measure_chroma_shift(empty, film(kGrey, kFromLeft)), 0.0F);
}

double matte_error(const Keyer& kept, const std::vector<Image>& frames) {
  Keyer keyer(kept);
  double sum = 0;
  for (int k = 0; k < 16; ++k) {
    const Sprite sprite = keyer.key(frames[static_cast<std::size_t>(k)]);
    const double left = kLeft + 0.25 * k, right = kRight + 0.25 * k;
    const int row = kHeight / 2 - sprite.top;
    for (int x = 0; x < sprite.width; ++x) {
      const double at = x + sprite.left, alpha = std::clamp(std::min(at + 0.5 - left, right - at + 0.5), 0.0, 1.0);
      sum += std::abs(sprite.at(x, row)[3] / 255.0 - alpha);
    }
  }
  return sum / 16;
}

TEST(ChromaShift, TheKeyerReadsColoursWhereTheyLie) {
  const Image empty(kWidth, kHeight, kGreen);
  for (const auto& weights : {kFromLeft, kFromRight}) {
    const std::vector<Image> frames = film(kShirt, weights);
    CleanPlate plate = clean_plate_of(empty, frames);
    plate.coarse_colour = true;
    const double heeded = matte_error(Keyer(plate), frames);
    plate.chroma_shift = 0;
    EXPECT_LT(heeded, 0.8 * matte_error(Keyer(plate), frames));
  }
}

}  // namespace
}  // namespace motex
