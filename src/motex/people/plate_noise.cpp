// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/plate_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "motex/core/parallel.h"
#include "motex/core/quantile.h"
#include "motex/image/mask.h"
#include "motex/image/pyramid.h"
#include "motex/people/fill_plane.h"
#include "motex/people/square_sums.h"

namespace motex {
namespace {

constexpr int kTile = 8;  // squares of 2 × 2 pixels
// χ² with 2 degrees of freedom: the light's share of the difference is not counted.
constexpr double kMedianOfTwo = 1.386, kHighOfTwo = 7.013, kHighShare = 0.97;
constexpr double kMostTail = 8;  // times the variance
constexpr std::size_t kMostFrames = 16;
constexpr double kActor = 8;  // deviations

/// Variance of a channel; negative where too few samples show the background.
double variance_of(const std::vector<double>& squares, std::size_t num_samples) {
  if (squares.size() * 8 < num_samples || squares.empty()) return -1;
  return quantile(squares, 0.5) / (4 * kMedianOfTwo);
}

double difference(const SquareSums& frame, const SquareSums& plate, std::size_t i) {
  std::array<float, 3> d{}, p{};
  for (std::size_t c = 0; c < 3; ++c) {
    p[c] = plate.channels[c][i];
    d[c] = static_cast<float>(frame.channels[c][i]) - p[c];
  }
  return squared_difference(d[0], d[1], d[2], p[0], p[1], p[2], LightRange{});
}

}  // namespace

Plane measure_plate_noise(const Image& picture, std::span<const Image> frames, double typical, PlateTexture texture,
                          const JobContext& job) {
  const std::size_t step = std::max<std::size_t>(1, (frames.size() + kMostFrames - 1) / kMostFrames);
  std::vector<SquareSums> sums((frames.size() + step - 1) / step);
  for (std::size_t k = 0; k < sums.size(); ++k) sum_squares(frames[k * step], sums[k]);
  SquareSums plate;
  sum_squares(picture, plate);
  const int width = plate.width, height = plate.height;
  const int columns = (width + kTile - 1) / kTile, rows = (height + kTile - 1) / kTile;
  const double limit = 16 * 3 * kActor * kActor * typical * typical;
  Plane tiles(columns, rows), own(width, height, -1), tails(columns, rows, 1);
  parallel_for(job.jobs, rows, [&](int row) {
    std::vector<double> all, here;
    for (int column = 0; column < columns; ++column) {
      all.clear();
      std::size_t num_samples = 0;
      for (int y = row * kTile; y < std::min(height, (row + 1) * kTile); ++y) {
        for (int x = column * kTile; x < std::min(width, (column + 1) * kTile); ++x) {
          here.clear();
          for (const SquareSums& frame : sums)
            if (const double square = difference(frame, plate, plate.index(x, y)); square < limit)
              here.push_back(square);
          all.insert(all.end(), here.begin(), here.end());
          num_samples += sums.size();
          if (texture == PlateTexture::kDetailed) own.at(x, y) = static_cast<float>(variance_of(here, sums.size()));
        }
      }
      const double variance = variance_of(all, num_samples);
      tiles.at(column, row) = static_cast<float>(variance);
      if (variance > 0)
        tails.at(column, row) = static_cast<float>(quantile(all, kHighShare) / (4 * kHighOfTwo) / variance);
    }
  });
  // Codecs make noise with longer tails than a normal one's: the usual excess widens it everywhere.
  const double tail = std::clamp(quantile({tails.values.begin(), tails.values.end()}, 0.5), 1.0, kMostTail);
  fill_unknown(tiles, threshold(tiles, 0));
  tiles = gaussian_blur(tiles, 0.7);
  Plane noise(width, height);
  const double least = std::max(kLeastPlateNoise, 0.5 * typical);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      float variance = tiles.at(x / kTile, y / kTile);
      if (texture == PlateTexture::kDetailed) variance = std::max(variance, own.at(x, y));
      noise.at(x, y) = static_cast<float>(
          std::clamp(std::sqrt(std::max(0.0, tail * static_cast<double>(variance))), least, kLargestPlateNoise));
    }
  }
  return noise;
}

}  // namespace motex
