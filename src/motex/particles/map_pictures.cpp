// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/particles/birth_death.h"

namespace motex {
namespace {

/// Weights of the source pixels under target pixel i: the area it covers, or its neighbours where the picture grows.
struct Cover {
  int first = 0;
  std::vector<double> weights;
};

std::vector<Cover> covers(int from, int to) {
  std::vector<Cover> out(static_cast<std::size_t>(to));
  const double ratio = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    Cover& cover = out[static_cast<std::size_t>(i)];
    if (ratio > 1) {
      const double low = i * ratio, high = (i + 1) * ratio;
      cover.first = static_cast<int>(low);
      for (int k = cover.first; k < from && k < high; ++k)
        cover.weights.push_back((std::min(high, k + 1.0) - std::max(low, static_cast<double>(k))) / ratio);
    } else {
      const double place = std::clamp((i + 0.5) * ratio - 0.5, 0.0, static_cast<double>(from - 1));
      cover.first = static_cast<int>(place);
      const double share = place - cover.first;
      cover.weights.push_back(1 - share);
      if (cover.first + 1 < from) cover.weights.push_back(share);
    }
  }
  return out;
}

Plane resampled(const Plane& plane, int width, int height) {
  if (plane.width == width && plane.height == height) return plane;
  const std::vector<Cover> columns = covers(plane.width, width), rows = covers(plane.height, height);
  Plane out(width, height);
  for (int y = 0; y < height; ++y) {
    const Cover& row = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < width; ++x) {
      const Cover& column = columns[static_cast<std::size_t>(x)];
      double sum = 0;
      for (std::size_t j = 0; j < row.weights.size(); ++j)
        for (std::size_t i = 0; i < column.weights.size(); ++i)
          sum += row.weights[j] * column.weights[i] *
                 static_cast<double>(plane.at(column.first + static_cast<int>(i), row.first + static_cast<int>(j)));
      out.at(x, y) = static_cast<float>(sum);
    }
  }
  return out;
}

Plane levels_of(const Image& picture, int width, int height) {
  if (width < 1 || height < 1 || picture.width < 1 || picture.height < 1)
    throw InvalidInput("a painted map and the picture it is for must have at least one pixel");
  return resampled(luma(picture), width, height);
}

}  // namespace

Image image_of_density(const Plane& density) {
  float largest = 0;
  for (const float value : density.values) largest = std::max(largest, value);
  Plane levels = density;
  for (float& value : levels.values) value = largest > 0 ? 255 * std::max(value, 0.0F) / largest : 0;
  return to_image(levels);
}

Image image_of_hazard(const Plane& hazard) {
  Plane levels = hazard;
  for (float& value : levels.values) value = 255 * std::sqrt(std::clamp(value, 0.0F, 1.0F));
  return to_image(levels);
}

Plane density_of_image(const Image& picture, int width, int height, double total) {
  Plane density = levels_of(picture, width, height);
  double sum = 0;
  for (const float value : density.values) sum += static_cast<double>(value);
  if (sum <= 0) throw InvalidInput("the painted map is black all over: paint some place white where elements shall be");
  for (float& value : density.values) value = static_cast<float>(static_cast<double>(value) * total / sum);
  return density;
}

Plane hazard_of_image(const Image& picture, int width, int height) {
  Plane hazard = levels_of(picture, width, height);
  for (float& value : hazard.values) value = (value / 255) * (value / 255);
  return hazard;
}

}  // namespace motex
