// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/pyramid.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr float kBinomial[5] = {1.0F / 16, 4.0F / 16, 6.0F / 16, 4.0F / 16, 1.0F / 16};

/// Σ_k weights[k] · source[clamp(x + k − reach)] along rows, then the result transposed.
Plane blurred_transposed(const Plane& source, const std::vector<float>& weights) {
  const int reach = static_cast<int>(weights.size() / 2);
  Plane out(source.height, source.width);
  for (int y = 0; y < source.height; ++y)
    for (int x = 0; x < source.width; ++x) {
      float sum = 0;
      for (int k = -reach; k <= reach; ++k)
        sum += weights[static_cast<std::size_t>(k + reach)] * source.at(std::clamp(x + k, 0, source.width - 1), y);
      out.at(y, x) = sum;
    }
  return out;
}

}  // namespace

Plane halve(const Plane& plane) {
  Plane half((plane.width + 1) / 2, (plane.height + 1) / 2);
  update_half(plane, half, 0, 0, half.width - 1, half.height - 1);
  return half;
}

void update_half(const Plane& plane, Plane& half, int left, int top, int right, int bottom) {
  left = std::max(left, 0);
  right = std::min(right, half.width - 1);
  std::vector<float> column(static_cast<std::size_t>(std::max(0, 2 * (right - left) + 5)));
  for (int y = std::max(top, 0); y <= std::min(bottom, half.height - 1); ++y) {
    for (std::size_t i = 0; i < column.size(); ++i) {
      const int x = std::clamp(2 * left - 2 + static_cast<int>(i), 0, plane.width - 1);
      float sum = 0;
      for (int k = -2; k <= 2; ++k) sum += kBinomial[k + 2] * plane.at(x, std::clamp(2 * y + k, 0, plane.height - 1));
      column[i] = sum;
    }
    for (int x = left; x <= right; ++x) {
      const float* c = column.data() + static_cast<std::size_t>(2 * (x - left));
      half.at(x, y) = kBinomial[0] * (c[0] + c[4]) + kBinomial[1] * (c[1] + c[3]) + kBinomial[2] * c[2];
    }
  }
}

std::vector<Plane> gaussian_pyramid(const Plane& plane, int num_levels) {
  std::vector<Plane> levels{plane};
  while (static_cast<int>(levels.size()) < num_levels) levels.push_back(halve(levels.back()));
  return levels;
}

Plane gaussian_blur(const Plane& plane, double sigma) {
  if (!(sigma >= 0 && sigma <= 1e4)) throw InvalidInput("the deviation of a blur must be 0 … 10000 pixels");
  if (sigma < 0.1) return plane;
  const int reach = static_cast<int>(std::ceil(3 * sigma));
  std::vector<float> weights;
  double total = 0;
  for (int k = -reach; k <= reach; ++k) {
    weights.push_back(static_cast<float>(std::exp(-k * k / (2 * sigma * sigma))));
    total += weights.back();
  }
  for (float& weight : weights) weight = static_cast<float>(weight / total);
  return blurred_transposed(blurred_transposed(plane, weights), weights);
}

}  // namespace motex
