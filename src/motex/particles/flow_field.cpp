// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/flow_field.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/parallel.h"
#include "motex/image/pyramid.h"

namespace motex {
namespace {

constexpr int kMaxPairs = 32;
constexpr double kFineSigma = 5;  // light that changes over larger areas does not show where it goes
constexpr double kMinStrength = 0.05;

struct Pair {
  Plane first, second;
};

/// Without what changes slowly over space: that has no sharp correlation peak.
Plane fine_part(const Plane& plane) {
  Plane fine = gaussian_blur(plane, kFineSigma);
  for (std::size_t i = 0; i < fine.values.size(); ++i) fine.values[i] = plane.values[i] - fine.values[i];
  return fine;
}

std::vector<Pair> pairs_over_the_clip(const std::vector<Plane>& residuals, int jobs) {
  const int num_all = static_cast<int>(residuals.size()) - 1, num = std::min(kMaxPairs, num_all);
  std::vector<Pair> pairs(static_cast<std::size_t>(num));
  parallel_for(jobs, num, [&](int k) {
    const auto t = static_cast<std::size_t>(static_cast<std::int64_t>(k) * num_all / num);
    pairs[static_cast<std::size_t>(k)] = {fine_part(residuals[t]), fine_part(residuals[t + 1])};
  });
  return pairs;
}

/// Σ over windows around grid points, rows first.
class WindowSums {
 public:
  WindowSums(int width, int height, const FlowFieldOptions& options)
      : options_(options),
        across_((width + options.spacing - 1) / options.spacing),
        down_((height + options.spacing - 1) / options.spacing) {}
  int across() const { return across_; }
  int down() const { return down_; }

  void operator()(const Plane& plane, std::vector<float>& table, float* out) const {
    const int width = plane.width, height = plane.height, stride = width + 1;
    table.assign(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height + 1), 0);
    for (int y = 0; y < height; ++y) {
      const float* row = plane.row(y);
      const float* above = table.data() + static_cast<std::ptrdiff_t>(y) * stride;
      float* here = table.data() + static_cast<std::ptrdiff_t>(y + 1) * stride;
      double sum = 0;
      for (int x = 0; x < width; ++x) {
        sum += static_cast<double>(row[x]);
        here[x + 1] = above[x + 1] + static_cast<float>(sum);
      }
    }
    const int half = options_.window / 2;
    for (int j = 0; j < down_; ++j)
      for (int i = 0; i < across_; ++i) {
        const int left = std::max(0, i * options_.spacing - half), right = std::min(width, i * options_.spacing + half);
        const int top = std::max(0, j * options_.spacing - half),
                  bottom = std::min(height, j * options_.spacing + half);
        const float* a = table.data() + static_cast<std::ptrdiff_t>(top) * stride;
        const float* b = table.data() + static_cast<std::ptrdiff_t>(bottom) * stride;
        *out++ = b[right] - b[left] - a[right] + a[left];
      }
  }

 private:
  FlowFieldOptions options_;
  int across_, down_;
};

void add_displaced_product(const Pair& pair, int dx, int dy, Plane& sum) {
  const int width = sum.width, height = sum.height;
  const int left = std::max(0, -dx), right = std::min(width, width - dx);
  for (int y = std::max(0, -dy); y < std::min(height, height - dy); ++y) {
    const float* a = pair.first.row(y);
    const float* b = pair.second.row(y + dy) + dx;
    float* out = sum.row(y);
    for (int x = left; x < right; ++x) out[x] += a[x] * b[x];
  }
}

/// Offset of the peak of the parabola through three values, −½ … ½.
double peak_offset(double before, double at, double after) {
  const double bend = before - 2 * at + after;
  return bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0;
}

/// The field of best displacements from correlations[d · points + point].
FlowField best_displacements(const std::vector<float>& correlations, const std::vector<float>& energy, int across,
                             int down, const FlowFieldOptions& options) {
  const int reach = options.max_speed, side = 2 * reach + 1;
  const auto points = static_cast<std::size_t>(across) * static_cast<std::size_t>(down);
  FlowField field{options.spacing, Plane(across, down), Plane(across, down), Plane(across, down)};
  for (std::size_t p = 0; p < points; ++p) {
    const auto value = [&](int dx, int dy) {
      return static_cast<double>(correlations[static_cast<std::size_t>((dy + reach) * side + dx + reach) * points + p]);
    };
    int best_x = 0, best_y = 0;
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx)
        if (value(dx, dy) > value(best_x, best_y)) best_x = dx, best_y = dy;
    const double peak = value(best_x, best_y);
    const bool inner = std::max(std::abs(best_x), std::abs(best_y)) < reach;
    const double off_x = inner ? peak_offset(value(best_x - 1, best_y), peak, value(best_x + 1, best_y)) : 0;
    const double off_y = inner ? peak_offset(value(best_x, best_y - 1), peak, value(best_x, best_y + 1)) : 0;
    field.vx.values[p] = static_cast<float>(best_x + off_x);
    field.vy.values[p] = static_cast<float>(best_y + off_y);
    field.strength.values[p] = energy[p] > 1e-6F ? std::clamp(static_cast<float>(peak) / energy[p], 0.0F, 1.0F) : 0;
  }
  return field;
}

/// Middle value of the 3 × 3 surroundings, each component: single wrong peaks go.
Plane median_of_neighbours(const Plane& plane) {
  Plane out = plane;
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x) {
      std::vector<float> around;
      for (int j = std::max(0, y - 1); j <= std::min(plane.height - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(plane.width - 1, x + 1); ++i) around.push_back(plane.at(i, j));
      std::nth_element(around.begin(), around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2), around.end());
      out.at(x, y) = around[around.size() / 2];
    }
  return out;
}

/// Mean of the neighbours weighted by how much light they move, so that still places take the velocity beside them.
void fill_in(FlowField& field, const std::vector<float>& energy, double sigma) {
  Plane weight(field.vx.width, field.vx.height), x = weight, y = weight;
  float most = 0;
  for (const float value : energy) most = std::max(most, value);
  for (std::size_t p = 0; p < energy.size(); ++p) {
    const bool moves = static_cast<double>(field.strength.values[p]) > kMinStrength;
    weight.values[p] = (moves ? field.strength.values[p] * energy[p] / (most + 1e-6F) : 0) + 1e-7F;
    x.values[p] = weight.values[p] * (moves ? field.vx.values[p] : 0);
    y.values[p] = weight.values[p] * (moves ? field.vy.values[p] : 0);
  }
  const double blur = sigma / field.spacing;
  weight = gaussian_blur(weight, blur);
  x = gaussian_blur(x, blur);
  y = gaussian_blur(y, blur);
  for (std::size_t p = 0; p < energy.size(); ++p) {
    field.vx.values[p] = x.values[p] / weight.values[p];
    field.vy.values[p] = y.values[p] / weight.values[p];
  }
}

}  // namespace

FlowField::Velocity FlowField::at(double x, double y) const {
  if (vx.values.empty()) return {};
  const double gx = std::clamp(x / spacing, 0.0, vx.width - 1.0), gy = std::clamp(y / spacing, 0.0, vx.height - 1.0);
  const int left = std::min(static_cast<int>(gx), std::max(0, vx.width - 2));
  const int top = std::min(static_cast<int>(gy), std::max(0, vx.height - 2));
  const int right = std::min(left + 1, vx.width - 1), bottom = std::min(top + 1, vx.height - 1);
  const double fx = gx - left, fy = gy - top;
  const auto blend = [&](const Plane& plane) {
    const double above =
        (1 - fx) * static_cast<double>(plane.at(left, top)) + fx * static_cast<double>(plane.at(right, top));
    const double below =
        (1 - fx) * static_cast<double>(plane.at(left, bottom)) + fx * static_cast<double>(plane.at(right, bottom));
    return (1 - fy) * above + fy * below;
  };
  return {blend(vx), blend(vy)};
}

FlowField estimate_flow_field(const std::vector<Plane>& residuals, const FlowFieldOptions& options, int jobs) {
  if (residuals.size() < 2) throw InvalidInput("a flow field needs at least two frames");
  const int width = residuals[0].width, height = residuals[0].height;
  for (const Plane& plane : residuals)
    if (plane.width != width || plane.height != height || plane.values.empty())
      throw InvalidInput("the frames of a flow field must have one size");
  const std::vector<Pair> pairs = pairs_over_the_clip(residuals, jobs);
  const WindowSums sums(width, height, options);
  const auto points = static_cast<std::size_t>(sums.across()) * static_cast<std::size_t>(sums.down());
  const int side = 2 * options.max_speed + 1;
  std::vector<float> correlations(points * static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  parallel_for(jobs, side, [&](int j) {
    std::vector<float> table;
    for (int i = 0; i < side; ++i) {
      Plane product(width, height);
      for (const Pair& pair : pairs) add_displaced_product(pair, i - options.max_speed, j - options.max_speed, product);
      sums(product, table, correlations.data() + static_cast<std::size_t>(j * side + i) * points);
    }
  });
  Plane squares(width, height);
  for (const Pair& pair : pairs) add_displaced_product({pair.first, pair.first}, 0, 0, squares);
  std::vector<float> table, energy(points);
  sums(squares, table, energy.data());
  FlowField field = best_displacements(correlations, energy, sums.across(), sums.down(), options);
  field.vx = median_of_neighbours(field.vx);
  field.vy = median_of_neighbours(field.vy);
  fill_in(field, energy, options.smoothing);
  return field;
}

}  // namespace motex
