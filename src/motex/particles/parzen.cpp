// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/parzen.h"

#include <algorithm>
#include <cmath>

namespace motex {
namespace {

constexpr double kEvenShare = 0.05;
constexpr std::size_t kNeighbour = 4, kMostAsked = 400;

/// Of distance 0, 1, …; both sides together sum to 1.
std::vector<double> window(double bandwidth) {
  const int reach = static_cast<int>(std::ceil(4 * bandwidth));
  std::vector<double> weights;
  double sum = 0;
  for (int k = 0; k <= reach; ++k) {
    weights.push_back(std::exp(-0.5 * k * k / (bandwidth * bandwidth)));
    sum += k == 0 ? 1 : 2 * weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

/// Pixel that the place i stands for when the row of n pixels is mirrored at its ends again and again.
int mirrored(int i, int n) {
  const int period = 2 * n, rest = ((i % period) + period) % period;
  return rest < n ? rest : period - 1 - rest;
}

/// What a point at i gets from itself and its mirror images.
double own_weight(const std::vector<double>& weights, int i, int n) {
  const int reach = static_cast<int>(weights.size()) - 1;
  double sum = 0;
  for (int k = -reach; k <= reach; ++k)
    if (mirrored(i + k, n) == i) sum += weights[static_cast<std::size_t>(std::abs(k))];
  return sum;
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
  std::vector<double> spread(columns * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {  // along rows, from the pixels that hold something
    double* target = spread.data() + static_cast<std::size_t>(y) * columns;
    for (int x = 0; x < width; ++x) {
      const double value = counts.at(x, y);
      if (value == 0) continue;
      for (int k = -reach; k <= reach; ++k)
        target[mirrored(x + k, width)] += value * weights[static_cast<std::size_t>(std::abs(k))];
    }
  }
  Plane out(width, height);
  std::vector<double> row(columns);
  for (int y = 0; y < height; ++y) {
    std::fill(row.begin(), row.end(), 0.0);
    for (int k = -reach; k <= reach; ++k) {
      const double* source = spread.data() + static_cast<std::size_t>(mirrored(y + k, height)) * columns;
      const double weight = weights[static_cast<std::size_t>(std::abs(k))];
      for (std::size_t x = 0; x < columns; ++x) row[x] += weight * source[x];
    }
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
  std::vector<double> own_x, own_y;
  for (int x = 0; x < counts.width; ++x) own_x.push_back(own_weight(weights, x, counts.width));
  for (int y = 0; y < counts.height; ++y) own_y.push_back(own_weight(weights, y, counts.height));
  const double even = kEvenShare / static_cast<double>(counts.values.size());
  double sum = 0;
  for (int y = 0; y < counts.height; ++y) {
    for (int x = 0; x < counts.width; ++x) {
      const double count = counts.at(x, y);
      if (count == 0) continue;
      const double own = own_x[static_cast<std::size_t>(x)] * own_y[static_cast<std::size_t>(y)];
      const double others = std::max(0.0, static_cast<double>(smooth.at(x, y)) - own) / (map.total() - 1);
      sum += count * std::log(even + (1 - kEvenShare) * others);
    }
  }
  return sum;
}

}  // namespace

namespace {

/// Half the distance to the fourth neighbour, in the median over points.
double neighbour_bandwidth(const PointCounts& map) {
  std::vector<std::pair<double, double>> points;
  const Plane& counts = map.counts();
  for (int y = 0; y < counts.height; ++y)
    for (int x = 0; x < counts.width; ++x)
      for (float left = counts.at(x, y); left > 0.5F; --left) points.emplace_back(x, y);
  if (points.size() <= kNeighbour) return 0;
  const std::size_t stride = 1 + points.size() / kMostAsked;
  std::vector<double> distances, medians;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    distances.clear();
    for (const auto& [x, y] : points) distances.push_back(std::hypot(x - points[i].first, y - points[i].second));
    std::nth_element(distances.begin(), distances.begin() + kNeighbour, distances.end());
    medians.push_back(distances[kNeighbour]);
  }
  const auto middle = medians.begin() + static_cast<std::ptrdiff_t>(medians.size() / 2);
  std::nth_element(medians.begin(), middle, medians.end());
  return *middle / 2;
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
  for (const PointCounts* map : maps) best = std::max(best, std::min(neighbour_bandwidth(*map), side / 4.0));
  return best;
}

}  // namespace motex
