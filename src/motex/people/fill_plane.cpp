// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/fill_plane.h"

#include <algorithm>
#include <vector>

namespace motex {
namespace {

/// Values and how far they are known, 0 … 1.
struct Level {
  Plane values, weights;
};

Level pulled(const Level& fine) {
  const int width = (fine.values.width + 1) / 2, height = (fine.values.height + 1) / 2;
  Level coarse{Plane(width, height), Plane(width, height)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      float sum = 0, weight = 0;
      for (int v = 2 * y; v <= std::min(2 * y + 1, fine.values.height - 1); ++v) {
        for (int u = 2 * x; u <= std::min(2 * x + 1, fine.values.width - 1); ++u) {
          sum += fine.weights.at(u, v) * fine.values.at(u, v);
          weight += fine.weights.at(u, v);
        }
      }
      coarse.values.at(x, y) = weight > 0 ? sum / weight : 0;
      coarse.weights.at(x, y) = std::min(1.0F, weight);
    }
  }
  return coarse;
}

float interpolated(const Plane& plane, float x, float y) {
  x = std::clamp(x, 0.0F, static_cast<float>(plane.width - 1));
  y = std::clamp(y, 0.0F, static_cast<float>(plane.height - 1));
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, plane.width - 1), bottom = std::min(top + 1, plane.height - 1);
  const float u = x - static_cast<float>(left), v = y - static_cast<float>(top);
  return (1 - v) * ((1 - u) * plane.at(left, top) + u * plane.at(right, top)) +
         v * ((1 - u) * plane.at(left, bottom) + u * plane.at(right, bottom));
}

void push(const Level& coarse, Level& fine) {
  for (int y = 0; y < fine.values.height; ++y) {
    for (int x = 0; x < fine.values.width; ++x) {
      const float weight = fine.weights.at(x, y);
      if (weight >= 1) continue;
      const float from =
          interpolated(coarse.values, (static_cast<float>(x) - 0.5F) / 2, (static_cast<float>(y) - 0.5F) / 2);
      float& value = fine.values.at(x, y);
      value = weight * value + (1 - weight) * from;
    }
  }
}

}  // namespace

void fill_unknown(Plane& plane, const Mask& known) {
  std::vector<Level> levels(1);
  levels[0] = {plane, Plane(plane.width, plane.height)};
  for (std::size_t i = 0; i < known.pixels.size(); ++i) levels[0].weights.values[i] = known.pixels[i] != 0 ? 1 : 0;
  while (levels.back().values.width > 1 || levels.back().values.height > 1) levels.push_back(pulled(levels.back()));
  for (std::size_t k = levels.size() - 1; k > 0; --k) push(levels[k], levels[k - 1]);
  plane = levels[0].values;
}

}  // namespace motex
