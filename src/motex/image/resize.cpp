// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/resize.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"

namespace motex {
namespace {

double catmull_rom(double d) {
  d = std::abs(d);
  if (d < 1) return (1.5 * d - 2.5) * d * d + 1;
  return d < 2 ? ((-0.5 * d + 2.5) * d - 4) * d + 2 : 0;
}

/// The pixels that one new pixel is a sum of.
struct Sum {
  int first = 0;
  std::vector<float> weights;
};

std::vector<Sum> sums_of(int from, int to) {
  std::vector<Sum> sums(static_cast<std::size_t>(to));
  const double step = static_cast<double>(from) / to, width = std::max(1.0, step);
  for (int k = 0; k < to; ++k) {
    const double centre = (k + 0.5) * step - 0.5;
    const int first = static_cast<int>(std::ceil(centre - 2 * width)), last = static_cast<int>(centre + 2 * width);
    std::vector<double> weights;
    double total = 0;
    Sum& sum = sums[static_cast<std::size_t>(k)];
    sum.first = std::clamp(first, 0, from - 1);
    for (int i = first; i <= last; ++i) {
      const double weight = catmull_rom((i - centre) / width);
      const auto place = static_cast<std::size_t>(std::clamp(i, 0, from - 1) - sum.first);
      weights.resize(std::max(weights.size(), place + 1));
      weights[place] += weight;
      total += weight;
    }
    for (const double weight : weights) sum.weights.push_back(static_cast<float>(weight / total));
  }
  return sums;
}

}  // namespace

Plane resized(const Plane& plane, int width, int height) {
  if (width < 1 || height < 1 || plane.width < 1 || plane.height < 1)
    throw InvalidInput("a picture cannot be resized from or to nothing");
  if (width == plane.width && height == plane.height) return plane;
  Plane wide(width, plane.height), out(width, height);
  const std::vector<Sum> across = sums_of(plane.width, width), down = sums_of(plane.height, height);
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < width; ++x) {
      const Sum& sum = across[static_cast<std::size_t>(x)];
      float value = 0;
      for (std::size_t i = 0; i < sum.weights.size(); ++i)
        value += sum.weights[i] * plane.row(y)[sum.first + static_cast<int>(i)];
      wide.at(x, y) = value;
    }
  for (int y = 0; y < height; ++y) {
    const Sum& sum = down[static_cast<std::size_t>(y)];
    float* const target = out.row(y);
    for (std::size_t i = 0; i < sum.weights.size(); ++i) {
      const float* const source = wide.row(sum.first + static_cast<int>(i));
      for (int x = 0; x < width; ++x) target[x] += sum.weights[i] * source[x];
    }
  }
  return out;
}

Planes resized(const Planes& planes, int width, int height) {
  Planes out;
  for (const Plane& plane : planes) out.push_back(resized(plane, width, height));
  return out;
}

}  // namespace motex
