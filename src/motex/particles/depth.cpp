// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/depth.h"

#include <algorithm>
#include <cmath>

#include "motex/core/quantile.h"

namespace motex {
namespace {

constexpr std::size_t kFewestFrames = 5;
constexpr double kSlowest = 0.2;  // pixels a frame: less is no parallax
constexpr double kLeastCorrelation = 0.3;

}  // namespace

DepthReport estimate_depth(const std::vector<Cable>& cables) {
  DepthReport report;
  report.depths.assign(cables.size(), 0);
  std::vector<std::size_t> used;
  std::vector<double> sizes, speeds;
  for (std::size_t k = 0; k < cables.size(); ++k) {
    const std::vector<Base>& core = cables[k].core;
    if (core.size() < kFewestFrames) continue;
    const auto span = static_cast<double>(core.size() - 1);
    const double speed = std::hypot(core.back().x - core.front().x, core.back().y - core.front().y) / span;
    if (speed < kSlowest) continue;
    std::vector<double> scales;
    for (const Base& base : core) scales.push_back(std::log(base.scale));
    used.push_back(k);
    sizes.push_back(median(scales));
    speeds.push_back(std::log(speed));
  }
  report.num_used = static_cast<int>(used.size());
  if (used.size() < 3) return report;
  const double middle_size = median(sizes), middle_speed = median(speeds);
  const auto num = static_cast<double>(used.size());
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (std::size_t k = 0; k < used.size(); ++k) {
    a += sizes[k] / num;
    b += speeds[k] / num;
  }
  for (std::size_t k = 0; k < used.size(); ++k) {
    aa += (sizes[k] - a) * (sizes[k] - a);
    bb += (speeds[k] - b) * (speeds[k] - b);
    ab += (sizes[k] - a) * (speeds[k] - b);
    report.depths[used[k]] = std::exp(-0.5 * (sizes[k] - middle_size + speeds[k] - middle_speed));
  }
  report.correlation = ab / std::sqrt(aa * bb + 1e-300);
  report.slope = std::abs(ab) > 1e-12 ? (bb - aa + std::sqrt((bb - aa) * (bb - aa) + 4 * ab * ab)) / (2 * ab) : 0;
  const double error = 1 / std::sqrt(num);
  report.reliable =
      report.correlation >= std::max(kLeastCorrelation, 3 * error) && report.slope >= 0.4 && report.slope <= 2.5;
  return report;
}

}  // namespace motex
