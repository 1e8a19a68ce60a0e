// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/quantile.h"
#include "motex/particles/cable_prior.h"

namespace motex {
namespace {

constexpr double kRobust = 1.4826;  // deviation of a normal law / its median absolute deviation
constexpr double kOutlier = 5;      // deviations
constexpr double kLeastPlaceStep = 0.03, kLeastScaleStep = 0.04, kLeastPeakStep = 0.05, kLeastTurn = 0.02;

/// Mean and deviation without outliers; `least` bounds the deviation.
Spread robust_spread(const std::vector<double>& values, double least) {
  if (values.empty()) return {0, least};
  const double centre = median(values);
  std::vector<double> away;
  for (const double v : values) away.push_back(std::abs(v - centre));
  const double reach = kOutlier * std::max(kRobust * median(away), least);
  double n = 0, sum = 0, squares = 0;
  for (const double v : values)
    if (std::abs(v - centre) <= reach) {
      ++n;
      sum += v - centre;
      squares += (v - centre) * (v - centre);
    }
  const double mean = sum / n;
  return {centre + mean, std::max(std::sqrt(std::max(squares / n - mean * mean, 0.0)), least)};
}

using CoordinateOf = double (*)(const Base&);

/// v_t = φ v_{t−1} + c + d n over all steps of all cables.
CoordinateDynamics regress_place(const std::vector<Cable>& cables, CoordinateOf of) {
  std::vector<double> starts, earlier, later;
  for (const Cable& cable : cables)
    for (std::size_t t = 1; t < cable.core.size(); ++t) {
      const double v = of(cable.core[t]) - of(cable.core[t - 1]);
      starts.push_back(v);
      if (t < 2) continue;
      earlier.push_back(of(cable.core[t - 1]) - of(cable.core[t - 2]));
      later.push_back(v);
    }
  const Spread speed = robust_spread(starts, kLeastPlaceStep);
  double phi = 0.5;
  std::vector<double> left;
  for (int round = 0; round < 3; ++round) {
    left.clear();
    for (std::size_t i = 0; i < later.size(); ++i)
      left.push_back(later[i] - speed.mean - phi * (earlier[i] - speed.mean));
    const Spread step = robust_spread(left, kLeastPlaceStep);
    double xx = 8 * speed.deviation * speed.deviation, xy = 0.5 * xx;  // a weak belief in one half
    for (std::size_t i = 0; i < later.size(); ++i) {
      const double u = earlier[i] - speed.mean, v = later[i] - speed.mean;
      if (std::abs(left[i] - step.mean) > kOutlier * step.deviation || std::abs(u) > kOutlier * speed.deviation)
        continue;
      xx += u * u;
      xy += u * v;
    }
    phi = std::clamp(xy / xx, -0.5, 0.99);
  }
  CoordinateDynamics line;
  line.a = 1 + phi;
  line.b = -phi;
  line.c = (1 - phi) * speed.mean;
  line.d = robust_spread(left, kLeastPlaceStep).deviation;
  line.a0 = 1;
  line.c0 = speed.mean;
  line.d0 = std::max(speed.deviation, line.d);
  return line;
}

CoordinateDynamics random_walk(const std::vector<Cable>& cables, CoordinateOf of, double least) {
  std::vector<double> steps;
  std::vector<std::pair<double, double>> pairs;
  for (const Cable& cable : cables)
    for (std::size_t t = 1; t < cable.core.size(); ++t) {
      steps.push_back(of(cable.core[t]) - of(cable.core[t - 1]));
      if (t > 1) pairs.emplace_back(steps[steps.size() - 2], steps.back());
    }
  const double whole = robust_spread(steps, least).deviation;
  // errors of measurement make successive steps anticorrelated: variance of a step + 2 · covariance is free of them
  double n = 0, sum = 0;
  for (const auto& [u, v] : pairs)
    if (std::abs(u) < kOutlier * whole && std::abs(v) < kOutlier * whole) {
      ++n;
      sum += 0.5 * (u * u + v * v) + 2 * u * v;
    }
  const double variance = n > 0 ? sum / n : whole * whole;
  CoordinateDynamics line;
  line.a = line.a0 = 1;
  line.b = line.c = line.c0 = 0;
  line.d = line.d0 = std::sqrt(std::max(variance, least * least));
  return line;
}

struct Counts {
  double first = 0, edge = 0, inside = 0;  // births
  double deaths_inside = 0, deaths_outside = 0;
  double steps_inside = 0, steps_outside = 0;
  double elements = 0;
};

Counts count(const std::vector<Cable>& cables, const CablePrior& prior, int num_frames) {
  Counts counts;
  const CoordinateDynamics &dx = prior.dynamics.x, &dy = prior.dynamics.y;
  const double m = prior.margin + 0.5;
  for (const Cable& cable : cables) {
    const Base& start = cable.core.front();
    const bool at_edge = start.x < prior.band_left - m || start.x > prior.width - 1 + m - prior.band_right ||
                         start.y < prior.band_top - m || start.y > prior.height - 1 + m - prior.band_bottom;
    (cable.first_frame == 0 ? counts.first : at_edge ? counts.edge : counts.inside) += 1;
    counts.elements += static_cast<double>(cable.core.size());
    for (std::size_t t = 0; t < cable.core.size(); ++t) {
      if (cable.first_frame + static_cast<std::int64_t>(t) + 1 >= num_frames) continue;
      const Base& now = cable.core[t];
      const double vx = t > 0 ? now.x - cable.core[t - 1].x : dx.c0, vy = t > 0 ? now.y - cable.core[t - 1].y : dy.c0;
      const bool inside = is_inside(now.x - dx.b * vx + (t > 0 ? dx.c : (1 + dx.b) * dx.c0),
                                    now.y - dy.b * vy + (t > 0 ? dy.c : (1 + dy.b) * dy.c0), prior.width, prior.height);
      const bool dies = t + 1 == cable.core.size();
      (inside ? counts.steps_inside : counts.steps_outside) += 1;
      if (dies) (inside ? counts.deaths_inside : counts.deaths_outside) += 1;
    }
  }
  return counts;
}

/// Depth of the band along each edge in which an element of the flow is first seen.
void set_bands(CablePrior& prior) {
  const auto depth = [&](const CoordinateDynamics& line, double sign) {
    return std::max(sign * line.c0 + 2 * line.d0, 0.0) + 1;
  };
  prior.band_left = depth(prior.dynamics.x, 1);
  prior.band_right = depth(prior.dynamics.x, -1);
  prior.band_top = depth(prior.dynamics.y, 1);
  prior.band_bottom = depth(prior.dynamics.y, -1);
}

}  // namespace

CablePrior estimate_prior(const std::vector<Cable>& cables, int width, int height,
                          const EstimatePriorOptions& options) {
  std::vector<double> scales, peaks;
  std::vector<double> spare;
  for (const Cable& cable : cables)
    if (!cable.core.empty()) {
      const Base& middle = cable.core[cable.core.size() / 2];
      scales.push_back(std::log(middle.scale));
      peaks.push_back(peak_amplitude(middle));
    }
  if (peaks.empty()) throw InvalidInput("prior of cables: there are no cables to estimate it from");
  CablePrior prior;
  prior.width = width;
  prior.height = height;
  prior.margin = options.margin;
  prior.noise = options.noise;
  prior.kind = cables.front().core.front().kind;
  prior.sign = median(peaks) < 0 ? -1 : 1;
  prior.min_coefficient = 7 * options.noise;
  prior.log_scale = robust_spread(scales, 0.1);
  prior.amplitude = robust_spread(peaks, 0.1 * std::abs(median(peaks)) + 1);
  prior.dynamics.x = regress_place(cables, [](const Base& base) { return base.x; });
  prior.dynamics.y = regress_place(cables, [](const Base& base) { return base.y; });
  prior.dynamics.log_scale = random_walk(
      cables, [](const Base& base) { return std::log(base.scale); }, kLeastScaleStep);
  prior.dynamics.amplitude = random_walk(
      cables, [](const Base& base) { return peak_amplitude(base); }, kLeastPeakStep * std::abs(prior.amplitude.mean));
  prior.dynamics.angle = random_walk(
      cables, [](const Base& base) { return base.angle; }, kLeastTurn);
  set_bands(prior);

  const int num_frames = std::max(options.num_frames, 1);
  const Counts counts = count(cables, prior, num_frames);
  const double grown_width = width + 2 * options.margin, grown_height = height + 2 * options.margin;
  const double area = grown_width * grown_height;
  const double inner = std::max(grown_width - prior.band_left - prior.band_right, 1.0) *
                       std::max(grown_height - prior.band_top - prior.band_bottom, 1.0);
  const double later_frames = std::max(num_frames - 1, 1), per_frame = counts.elements / num_frames;
  prior.density_first = (counts.first + 1) / area;
  const double inside =
      std::min((counts.inside + 0.5) / later_frames, options.max_birth_share * std::max(per_frame, 1.0));
  prior.births_inside = inside / area;
  prior.births_edge = (counts.edge + 1) / later_frames / std::max(area - inner, 1.0);
  prior.death_inside =
      std::clamp((counts.deaths_inside + 0.5) / (counts.steps_inside + 10), 1e-4, options.max_death_inside);
  prior.death_outside = std::clamp((counts.deaths_outside + 1) / (counts.steps_outside + 2), 0.3, 0.98);
  return prior;
}

}  // namespace motex
