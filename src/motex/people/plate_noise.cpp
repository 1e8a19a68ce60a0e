// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/plate_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "motex/core/parallel.h"
#include "motex/core/quantile.h"
#include "motex/image/mask.h"
#include "motex/image/pyramid.h"
#include "motex/people/fill_plane.h"

namespace motex {
namespace {

constexpr int kTile = 8;                  // squares of 2 × 2 pixels
constexpr double kMedianOfThree = 2.366;  // of χ² with 3 degrees of freedom
constexpr std::size_t kMostFrames = 16;
constexpr double kActor = 8;  // deviations

/// Σ over R, G, B of (difference of the sums of 2 × 2 pixels)²; its mean is 3 · 4 σ² where pixels are independent.
double squared_difference(const Image& frame, const Image& picture, int column, int row) {
  std::array<int, 3> sums{};
  int count = 0;
  for (int y = 2 * row; y <= std::min(2 * row + 1, picture.height - 1); ++y) {
    for (int x = 2 * column; x <= std::min(2 * column + 1, picture.width - 1); ++x, ++count) {
      const Rgba &a = frame.at(x, y), &b = picture.at(x, y);
      sums[0] += a.r - b.r, sums[1] += a.g - b.g, sums[2] += a.b - b.b;
    }
  }
  const double scale = 4.0 / count;
  return scale * scale * (sums[0] * sums[0] + sums[1] * sums[1] + sums[2] * sums[2]);
}

/// Variance of a channel; negative where too few samples show the background.
double variance_of(std::vector<double>& squares, std::size_t num_samples) {
  if (squares.size() * 8 < num_samples || squares.empty()) return -1;
  return quantile(std::move(squares), 0.5) / (4 * kMedianOfThree);
}

}  // namespace

Plane measure_plate_noise(const Image& picture, std::span<const Image> frames, double typical, PlateTexture texture,
                          const JobContext& job) {
  const int width = (picture.width + 1) / 2, height = (picture.height + 1) / 2;
  const int columns = (width + kTile - 1) / kTile, rows = (height + kTile - 1) / kTile;
  const std::size_t step = (frames.size() + kMostFrames - 1) / kMostFrames;
  const double limit = 16 * 3 * kActor * kActor * typical * typical;
  Plane tiles(columns, rows), own(width, height, -1);
  parallel_for(job.jobs, rows, [&](int row) {
    for (int column = 0; column < columns; ++column) {
      std::vector<double> all;
      std::size_t num_samples = 0;
      for (int y = row * kTile; y < std::min(height, (row + 1) * kTile); ++y) {
        for (int x = column * kTile; x < std::min(width, (column + 1) * kTile); ++x) {
          std::vector<double> here;
          for (std::size_t k = 0; k < frames.size(); k += step, ++num_samples)
            if (const double square = squared_difference(frames[k], picture, x, y); square < limit)
              here.push_back(square);
          all.insert(all.end(), here.begin(), here.end());
          own.at(x, y) = static_cast<float>(variance_of(here, (frames.size() + step - 1) / step));
        }
      }
      tiles.at(column, row) = static_cast<float>(variance_of(all, num_samples));
    }
  });
  fill_unknown(tiles, threshold(tiles, 0));
  tiles = gaussian_blur(tiles, 0.7);
  Plane noise(width, height);
  const double least = std::max(kLeastPlateNoise, 0.5 * typical);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      float variance = tiles.at(x / kTile, y / kTile);
      if (texture == PlateTexture::kDetailed) variance = std::max(variance, own.at(x, y));
      noise.at(x, y) = static_cast<float>(std::max(least, std::sqrt(std::max(0.0, static_cast<double>(variance)))));
    }
  }
  return noise;
}

}  // namespace motex
