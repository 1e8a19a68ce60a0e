// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/fit_dynamics.h"

#include <algorithm>
#include <cmath>

#include "motex/core/options_check.h"
#include "motex/particles/noisy_autoregression.h"
#include "motex/particles/random_effects.h"

namespace motex {
namespace {

constexpr double kCutAt = 7;  // robust deviations

enum class Coordinate { kX, kY, kLogScale, kAngle, kAmplitude };

bool is_place(Coordinate coordinate) { return coordinate == Coordinate::kX || coordinate == Coordinate::kY; }

double value_of(const Base& base, Coordinate coordinate) {
  switch (coordinate) {
    case Coordinate::kX:
      return base.x;
    case Coordinate::kY:
      return base.y;
    case Coordinate::kLogScale:
      return std::log(std::max(base.scale, 1e-3));
    case Coordinate::kAngle:
      return base.angle;
    case Coordinate::kAmplitude:
      break;
  }
  return peak_amplitude(base);
}

DynamicsPrior prior_of(Coordinate coordinate, double steps) {
  if (is_place(coordinate)) return {steps, 0.7, 0.3, 0.01};
  if (coordinate == Coordinate::kLogScale) return {steps, 0.7, 0.05, 0.005};
  if (coordinate == Coordinate::kAngle) return {steps, 0.7, 0.05, 0.005};
  return {steps, 0.7, 5, 0.1};
}

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// How the velocity (of a place) or the value changes from t − 1 to t.
double change(const std::vector<double>& z, std::size_t t, bool place) {
  return place ? z[t] - 2 * z[t - 1] + z[t - 2] : z[t] - z[t - 1];
}

/// Pieces between steps that are far from all others.
std::vector<CoordinateSeries> cut_at_leaps(const std::vector<CoordinateSeries>& series, bool place, double smallest,
                                           std::int64_t& num_cuts) {
  const std::size_t first = place ? 2 : 1;
  std::vector<double> changes;
  for (const CoordinateSeries& one : series)
    for (std::size_t t = first; t < one.values.size(); ++t) changes.push_back(change(one.values, t, place));
  const double middle = median_of(changes);
  for (double& value : changes) value = std::abs(value - middle);
  const double limit = kCutAt * std::max(1.4826 * median_of(changes), smallest);
  std::vector<CoordinateSeries> pieces;
  for (const CoordinateSeries& one : series) {
    CoordinateSeries piece{{}, one.from_birth};
    for (std::size_t t = 0; t < one.values.size(); ++t) {
      if (t >= first && piece.values.size() >= first && std::abs(change(one.values, t, place) - middle) > limit) {
        pieces.push_back(std::move(piece));
        piece = {{}, false};
        ++num_cuts;
      }
      piece.values.push_back(one.values[t]);
    }
    pieces.push_back(std::move(piece));
  }
  std::erase_if(pieces, [](const CoordinateSeries& piece) { return piece.values.empty(); });
  return pieces;
}

std::vector<CoordinateSeries> series_of(std::span<const Cable> cables, Coordinate coordinate) {
  std::vector<CoordinateSeries> series;
  for (const Cable& cable : cables) {
    CoordinateSeries one;
    one.from_birth = cable.first_frame > 0;
    one.values.reserve(cable.core.size());
    for (const Base& base : cable.core) one.values.push_back(value_of(base, coordinate));
    if (!one.values.empty()) series.push_back(std::move(one));
  }
  return series;
}

std::vector<CoordinateSeries> differences(const std::vector<CoordinateSeries>& series) {
  std::vector<CoordinateSeries> out;
  for (const CoordinateSeries& one : series) {
    if (one.values.size() < 2) continue;
    CoordinateSeries& steps = out.emplace_back();
    steps.from_birth = one.from_birth;
    for (std::size_t t = 1; t < one.values.size(); ++t) steps.values.push_back(one.values[t] - one.values[t - 1]);
  }
  return out;
}

/// Mean and deviation of first steps: of those that were born in sight where there are enough.
void set_first_step(CoordinateDynamics& dynamics, const std::vector<CoordinateSeries>& steps, double error,
                    const DynamicsPrior& prior) {
  std::vector<double> firsts, others;
  for (const CoordinateSeries& one : steps) (one.from_birth ? firsts : others).push_back(one.values[0]);
  if (firsts.size() < 8) firsts.insert(firsts.end(), others.begin(), others.end());
  double mean = 0, square = 0;
  for (const double step : firsts) mean += step;
  mean = firsts.empty() ? dynamics.mean_velocity() : mean / static_cast<double>(firsts.size());
  for (const double step : firsts) square += (step - mean) * (step - mean);
  const auto count = static_cast<double>(firsts.size());
  const double variance =
      (square + prior.steps * prior.noise * prior.noise) / std::max(1.0, count + prior.steps - 1) - 2 * error * error;
  dynamics.a0 = 1;
  dynamics.c0 = mean;
  dynamics.d0 = std::sqrt(std::max(variance, dynamics.d * dynamics.d));
}

CoordinateDynamics fit_place(const std::vector<CoordinateSeries>& pieces, double& error, const DynamicsPrior& prior) {
  CoordinateDynamics dynamics;
  double persistence = 0, mean = 0;
  const std::vector<CoordinateSeries> steps = differences(pieces);
  if (error == 0) {
    const AutoregressionFit fit = fit_random_effects(steps, 1, prior);
    persistence = std::clamp(fit.lag1, -0.99, 0.995);
    // a clamped persistence keeps the mean velocity
    mean = fit.lag1 < 0.995 ? fit.constant / (1 - fit.lag1) : fit.start_mean;
    dynamics.d = fit.noise;
    dynamics.c_spread = fit.spread;
    dynamics.c_slope = fit.slope;
    dynamics.start_mean = fit.start_mean;
    dynamics.start_deviation = fit.start_deviation;
  } else {
    const NoisyAutoregressionFit fit = fit_noisy_autoregression(pieces, MeasuredValue::kPlace, error, prior);
    persistence = fit.persistence;
    mean = fit.mean;
    error = fit.error;
    dynamics.d = fit.noise;
    dynamics.c_spread = (1 - persistence) * fit.spread;
    dynamics.start_mean = fit.start_mean;
    dynamics.start_deviation = fit.start_deviation;
    const double variance = fit.start_deviation * fit.start_deviation;
    dynamics.c_slope = variance > 0 ? (1 - persistence) * fit.spread * fit.spread / variance : 0;
  }
  dynamics.a = 1 + persistence;
  dynamics.b = -persistence;
  dynamics.c = (1 - persistence) * mean;
  set_first_step(dynamics, steps, error, prior);
  return dynamics;
}

/// z_{t_b+1} = a₀ z_{t_b} + c₀ + d₀ n by regression, pulled towards a₀ = 1, c₀ = 0 by the prior.
void set_second_value(CoordinateDynamics& dynamics, const std::vector<CoordinateSeries>& pieces,
                      const DynamicsPrior& prior) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (const CoordinateSeries& one : pieces) {
    if (one.values.size() < 2) continue;
    n += 1;
    x += one.values[0];
    y += one.values[1];
  }
  if (n > 0) {
    x /= n;
    y /= n;
  }
  for (const CoordinateSeries& one : pieces) {
    if (one.values.size() < 2) continue;
    xx += (one.values[0] - x) * (one.values[0] - x);
    xy += (one.values[0] - x) * (one.values[1] - y);
    yy += (one.values[1] - y) * (one.values[1] - y);
  }
  const double weight = prior.steps * std::max(prior.noise * prior.noise, n > 1 ? xx / n : 0.0) + 1e-12;
  dynamics.a0 = (xy + weight) / (xx + weight);
  dynamics.c0 = y - dynamics.a0 * x;
  const double residual = yy - 2 * dynamics.a0 * xy + dynamics.a0 * dynamics.a0 * xx;
  const double variance =
      (std::max(residual, 0.0) + prior.steps * prior.noise * prior.noise) / (n + prior.steps + 1e-9);
  dynamics.d0 = std::max(std::sqrt(variance), prior.smallest_noise);
}

/// Roots of z² = a z + b inside the circle of radius 0.999, or the dynamics would run away.
void keep_stable(double& a, double& b) {
  const double discriminant = a * a + 4 * b;
  const double radius = discriminant < 0 ? std::sqrt(-b) : (std::abs(a) + std::sqrt(discriminant)) / 2;
  if (radius <= 0.999) return;
  const double shrink = 0.999 / radius;
  a *= shrink;
  b *= shrink * shrink;
}

CoordinateDynamics fit_level(const std::vector<CoordinateSeries>& pieces, double error, const DynamicsPrior& prior) {
  CoordinateDynamics dynamics;
  if (error == 0) {
    const AutoregressionFit fit = fit_random_effects(pieces, 2, prior);
    dynamics.a = fit.lag1;
    dynamics.b = fit.lag2;
    dynamics.c = fit.constant;
    const double rest = 1 - fit.lag1 - fit.lag2;
    keep_stable(dynamics.a, dynamics.b);
    if (dynamics.a != fit.lag1) {  // about the same level
      const double level = std::abs(rest) > 1e-3 ? fit.constant / rest : fit.start_mean;
      dynamics.c = level * (1 - dynamics.a - dynamics.b);
    }
    dynamics.d = fit.noise;
    dynamics.c_spread = fit.spread;
    dynamics.c_slope = fit.slope;
    dynamics.start_mean = fit.start_mean;
    dynamics.start_deviation = fit.start_deviation;
    set_second_value(dynamics, pieces, prior);
  } else {
    const NoisyAutoregressionFit fit = fit_noisy_autoregression(pieces, MeasuredValue::kLevel, error, prior);
    dynamics.a = fit.persistence;
    dynamics.b = 0;
    dynamics.c = (1 - fit.persistence) * fit.mean;
    dynamics.d = fit.noise;
    dynamics.c_spread = (1 - fit.persistence) * fit.spread;
    dynamics.start_mean = fit.start_mean;
    dynamics.start_deviation = fit.start_deviation;
    const double variance = fit.start_deviation * fit.start_deviation;
    dynamics.c_slope = variance > 0 ? (1 - fit.persistence) * fit.spread * fit.spread / variance : 0;
    dynamics.a0 = dynamics.a;
    dynamics.c0 = dynamics.c;
    dynamics.d0 = dynamics.d;
  }
  return dynamics;
}

}  // namespace

MovetonDynamics fit_dynamics(std::span<const Cable> cables, const FitDynamicsOptions& options,
                             FitDynamicsReport* report) {
  check_options(options);
  FitDynamicsReport counts;
  for (const Cable& cable : cables) {
    if (cable.num_frames() < 2) continue;
    ++counts.num_cables;
    counts.num_steps += cable.num_frames() - 1;
  }
  const auto fit = [&](Coordinate coordinate, double given, double* found) {
    const DynamicsPrior prior = prior_of(coordinate, options.prior_steps);
    const bool place = is_place(coordinate);
    std::int64_t cuts = 0;
    const std::vector<CoordinateSeries> pieces =
        cut_at_leaps(series_of(cables, coordinate), place, prior.smallest_noise, cuts);
    double error = options.estimate_errors ? -1 : given;
    if (!place) return fit_level(pieces, error, prior);
    counts.num_cuts += cuts;
    const CoordinateDynamics dynamics = fit_place(pieces, error, prior);
    *found = error;
    return dynamics;
  };
  MovetonDynamics out;
  out.x = fit(Coordinate::kX, options.position_error, &counts.position_error_x);
  out.y = fit(Coordinate::kY, options.position_error, &counts.position_error_y);
  out.log_scale = fit(Coordinate::kLogScale, options.log_scale_error, nullptr);
  out.angle = fit(Coordinate::kAngle, options.angle_error, nullptr);
  out.amplitude = fit(Coordinate::kAmplitude, options.amplitude_error, nullptr);
  if (report != nullptr) *report = counts;
  return out;
}

double draw_cable_constant(const CoordinateDynamics& dynamics, double start, Rng& rng) {
  const double explained = dynamics.c_slope * dynamics.start_deviation;
  const double rest = std::sqrt(std::max(0.0, dynamics.c_spread * dynamics.c_spread - explained * explained));
  return dynamics.c + dynamics.c_slope * (start - dynamics.start_mean) + rest * rng.normal();
}

}  // namespace motex
