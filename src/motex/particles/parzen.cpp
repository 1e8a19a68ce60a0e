// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/parzen.h"

#include <algorithm>
#include <cmath>

namespace motex {
namespace {

constexpr double kEvenShare = 0.05;

std::vector<double> window(double bandwidth) {
  const int reach = static_cast<int>(std::ceil(4 * bandwidth));
  std::vector<double> weights;
  for (int k = 0; k <= reach; ++k) weights.push_back(std::exp(-0.5 * k * k / (bandwidth * bandwidth)));
  return weights;
}

/// Sum of the window around each of n pixels in a row, inside the row.
std::vector<double> mass_inside(const std::vector<double>& weights, int n) {
  std::vector<double> mass(static_cast<std::size_t>(n));
  const int reach = static_cast<int>(weights.size()) - 1;
  for (int i = 0; i < n; ++i)
    for (int j = std::max(0, i - reach); j <= std::min(n - 1, i + reach); ++j)
      mass[static_cast<std::size_t>(i)] += weights[static_cast<std::size_t>(std::abs(i - j))];
  return mass;
}

/// Adds weight · source row to the target row.
void add_row(const double* source, double weight, double* target, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) target[i] += weight * source[i];
}

}  // namespace

PointCounts::PointCounts(int width, int height) : counts_(width, height) {}

void PointCounts::add(double x, double y, double weight) {
  if (counts_.width == 0 || counts_.height == 0 || !std::isfinite(x) || !std::isfinite(y)) return;
  const auto pixel = [](double place, int size) {
    return static_cast<int>(std::clamp(std::floor(place + 0.5), 0.0, static_cast<double>(size - 1)));
  };
  counts_.at(pixel(x, counts_.width), pixel(y, counts_.height)) += static_cast<float>(weight);
  total_ += weight;
}

Plane parzen_smooth(const Plane& counts, double bandwidth) {
  if (bandwidth <= 0 || counts.values.empty()) return counts;
  const std::vector<double> weights = window(bandwidth);
  const int reach = static_cast<int>(weights.size()) - 1, width = counts.width, height = counts.height;
  const auto columns = static_cast<std::size_t>(width);
  const std::vector<double> mass_x = mass_inside(weights, width), mass_y = mass_inside(weights, height);
  std::vector<double> spread(columns * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {  // along rows, from the pixels that hold something
    double* target = spread.data() + static_cast<std::size_t>(y) * columns;
    for (int x = 0; x < width; ++x) {
      if (counts.at(x, y) == 0) continue;
      const double value = static_cast<double>(counts.at(x, y)) / mass_x[static_cast<std::size_t>(x)];
      for (int i = std::max(0, x - reach); i <= std::min(width - 1, x + reach); ++i)
        target[i] += value * weights[static_cast<std::size_t>(std::abs(i - x))];
    }
  }
  Plane out(width, height);
  std::vector<double> row(columns);
  for (int y = 0; y < height; ++y) {
    std::fill(row.begin(), row.end(), 0.0);
    for (int j = std::max(0, y - reach); j <= std::min(height - 1, y + reach); ++j)
      add_row(spread.data() + static_cast<std::size_t>(j) * columns,
              weights[static_cast<std::size_t>(std::abs(j - y))] / mass_y[static_cast<std::size_t>(j)], row.data(),
              columns);
    for (int x = 0; x < width; ++x) out.at(x, y) = static_cast<float>(row[static_cast<std::size_t>(x)]);
  }
  return out;
}

namespace {

/// Σ log density of each point under the others.
double leave_one_out(const PointCounts& map, double bandwidth) {
  const Plane& counts = map.counts();
  const Plane smooth = parzen_smooth(counts, bandwidth);
  const std::vector<double> weights = window(bandwidth);
  const std::vector<double> mass_x = mass_inside(weights, counts.width), mass_y = mass_inside(weights, counts.height);
  const double even = kEvenShare / static_cast<double>(counts.values.size());
  double sum = 0;
  for (int y = 0; y < counts.height; ++y) {
    for (int x = 0; x < counts.width; ++x) {
      const double count = counts.at(x, y);
      if (count == 0) continue;
      const double own = 1 / (mass_x[static_cast<std::size_t>(x)] * mass_y[static_cast<std::size_t>(y)]);
      const double others = std::max(0.0, static_cast<double>(smooth.at(x, y)) - own) / (map.total() - 1);
      sum += count * std::log(even + (1 - kEvenShare) * others);
    }
  }
  return sum;
}

}  // namespace

double choose_bandwidth(const std::vector<const PointCounts*>& maps) {
  int side = 16;
  bool enough = false;
  for (const PointCounts* map : maps) {
    side = std::min(map->counts().width, map->counts().height);
    enough = enough || map->total() >= 2;
  }
  double best = std::max(1.0, side / 16.0), highest = 0;
  if (!enough) return best;
  bool first = true;
  for (double bandwidth = 1; first || bandwidth <= side / 4.0; bandwidth *= std::sqrt(2.0)) {
    double sum = 0;
    for (const PointCounts* map : maps)
      if (map->total() >= 2) sum += leave_one_out(*map, bandwidth);
    if (first || sum > highest) {
      highest = sum;
      best = bandwidth;
    }
    first = false;
  }
  return best;
}

}  // namespace motex
