// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/cable_prior.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace motex {
namespace {

constexpr double kLogRootTwoPi = 0.9189385332046727;
constexpr double kTiny = 1e-12;

double log_normal(double deviation_in_units, double inverse, double log_norm) {
  const double u = deviation_in_units * inverse;
  return log_norm - 0.5 * u * u;
}

/// Probability that a new element has the minimum energy and the sign: midpoints over both spreads.
double possible_share(const CablePrior& prior) {
  constexpr int kSteps = 24;
  const double factor = coefficient_factor(prior.kind);
  double share = 0, total = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double u = -3 + 6 * (i + 0.5) / kSteps, log_scale = prior.log_scale.mean + u * prior.log_scale.deviation;
    const double weight = std::exp(-0.5 * u * u);
    total += weight;
    if (log_scale < std::log(prior.min_scale) || log_scale > std::log(prior.max_scale)) continue;
    const double least = prior.min_coefficient / (factor * std::exp(log_scale));
    const double unit = prior.amplitude.deviation * std::numbers::sqrt2;
    const double above = 0.5 * std::erfc((least - prior.amplitude.mean) / unit),
                 below = 0.5 * std::erfc((least + prior.amplitude.mean) / unit);
    share += weight * ((prior.sign >= 0 ? above : 0) + (prior.sign <= 0 ? below : 0));
  }
  return std::max(share / total, 1e-6);
}

}  // namespace

bool is_round(BaseKind kind) { return kind == BaseKind::kGaussian || kind == BaseKind::kLog; }

double coefficient_factor(BaseKind kind) {
  constexpr double kPi = std::numbers::pi;
  const double w = kGaborFrequency, mean = std::exp(-w * w / 2);
  switch (kind) {
    case BaseKind::kGaussian:
      return std::sqrt(kPi);
    case BaseKind::kLog:
      return std::sqrt(2 * kPi) / 2;
    case BaseKind::kGaborCos: {
      const double across = 0.5 * (1 + std::exp(-w * w)) - 2 * mean * std::exp(-w * w / 4) + mean * mean;
      return std::sqrt(2 * kPi * across) / (1 - mean);
    }
    case BaseKind::kStreak:
      return std::sqrt(kGaborElongation * kPi);
    case BaseKind::kGaborSin:
      return std::sqrt(kPi * (1 - std::exp(-w * w))) / 0.59501;
  }
  return 1;
}

CoreState core_state(const Base& base) {
  return {base.x, base.y, std::log(base.scale), peak_amplitude(base), base.angle};
}

Base core_base(BaseKind kind, const CoreState& state) {
  Base base;
  base.kind = kind;
  base.x = state[kCoreX];
  base.y = state[kCoreY];
  base.scale = std::exp(state[kCoreLogScale]);
  base.angle = is_round(kind) ? 0 : state[kCoreAngle];
  base.coefficients[0] = static_cast<float>(coefficient_of_peak(base, state[kCoreAmplitude]));
  return base;
}

CableLaw::CableLaw(const CablePrior& prior, int num_frames) : prior_(prior), num_frames_(num_frames), lines_{} {
  const MovetonDynamics& all = prior.dynamics;
  const std::array<const CoordinateDynamics*, kNumCoreCoordinates> of{&all.x, &all.y, &all.log_scale, &all.amplitude,
                                                                      &all.angle};
  for (std::size_t k = 0; k < of.size(); ++k) {
    const CoordinateDynamics& line = *of[k];
    const double d = std::max(std::hypot(line.d, line.c_spread), 1e-6), d0 = std::max(line.d0, 1e-6);
    lines_[k] = {line.a,
                 line.b,
                 line.c,
                 1 / d,
                 -std::log(d) - kLogRootTwoPi,
                 line.a0,
                 line.c0,
                 1 / d0,
                 -std::log(d0) - kLogRootTwoPi};
  }
  log_first_ = std::log(std::max(prior.density_first, kTiny));
  log_inside_ = std::log(std::max(prior.births_inside, kTiny));
  log_edge_ = std::log(std::max(prior.births_inside + prior.births_edge, kTiny));
  const double inside = std::clamp(prior.death_inside, 1e-6, 1 - 1e-6),
               outside = std::clamp(prior.death_outside, 1e-6, 1 - 1e-6);
  log_die_inside_ = std::log(inside);
  log_go_inside_ = std::log(1 - inside);
  log_die_outside_ = std::log(outside);
  log_go_outside_ = std::log(1 - outside);
  log_birth_norm_ = -std::log(prior.log_scale.deviation) - std::log(prior.amplitude.deviation) - 2 * kLogRootTwoPi -
                    std::log(possible_share(prior));
  if (!is_round(prior.kind))
    log_birth_norm_ -= std::log(prior.kind == BaseKind::kGaborSin ? 2 * std::numbers::pi : std::numbers::pi);
}

int CableLaw::num_coordinates(BaseKind kind) const { return is_round(kind) ? kCoreAngle : kNumCoreCoordinates; }

bool CableLaw::is_possible(BaseKind kind, const CoreState& z) const {
  const double margin = prior_.margin + 0.5, scale = std::exp(z[kCoreLogScale]), peak = z[kCoreAmplitude];
  return z[kCoreX] >= -margin && z[kCoreX] < prior_.width - 1 + margin && z[kCoreY] >= -margin &&
         z[kCoreY] < prior_.height - 1 + margin && scale >= prior_.min_scale && scale <= prior_.max_scale &&
         prior_.sign * peak >= 0 && std::abs(peak) * scale * coefficient_factor(kind) >= prior_.min_coefficient;
}

double CableLaw::log_birth(const CoreState& z, int frame) const {
  const double scale = (z[kCoreLogScale] - prior_.log_scale.mean) / prior_.log_scale.deviation,
               peak = (z[kCoreAmplitude] - prior_.amplitude.mean) / prior_.amplitude.deviation;
  const double m = prior_.margin + 0.5;
  const bool at_edge = z[kCoreX] < prior_.band_left - m || z[kCoreX] > prior_.width - 1 + m - prior_.band_right ||
                       z[kCoreY] < prior_.band_top - m || z[kCoreY] > prior_.height - 1 + m - prior_.band_bottom;
  return (frame == 0 ? log_first_
          : at_edge  ? log_edge_
                     : log_inside_) +
         log_birth_norm_ - 0.5 * (scale * scale + peak * peak);
}

double CableLaw::log_first_step(BaseKind kind, const CoreState& before, const CoreState& z) const {
  double sum = 0;
  for (std::size_t k = 0, n = static_cast<std::size_t>(num_coordinates(kind)); k < n; ++k) {
    const Line& line = lines_[k];
    sum += log_normal(z[k] - line.a0 * before[k] - line.c0, line.inverse0, line.log_norm0);
  }
  return sum;
}

double CableLaw::log_step(BaseKind kind, const CoreState& before2, const CoreState& before, const CoreState& z) const {
  double sum = 0;
  for (std::size_t k = 0, n = static_cast<std::size_t>(num_coordinates(kind)); k < n; ++k) {
    const Line& line = lines_[k];
    sum += log_normal(z[k] - line.a * before[k] - line.b * before2[k] - line.c, line.inverse, line.log_norm);
  }
  return sum;
}

CoreState CableLaw::expected(const CoreState* before2, const CoreState& before) const {
  CoreState mean{};
  for (std::size_t k = 0; k < mean.size(); ++k) {
    const Line& line = lines_[k];
    mean[k] = before2 == nullptr ? line.a0 * before[k] + line.c0 : line.a * before[k] + line.b * (*before2)[k] + line.c;
  }
  return mean;
}

double CableLaw::step_deviation(int coordinate, bool is_first) const {
  const Line& line = lines_[static_cast<std::size_t>(coordinate)];
  return 1 / (is_first ? line.inverse0 : line.inverse);
}

double CableLaw::log_end(const CoreState* before, const CoreState& z, int frame, bool goes_on) const {
  if (frame + 1 >= num_frames_) return 0;
  const Line &x = lines_[kCoreX], &y = lines_[kCoreY];
  const double next_x = before == nullptr ? x.a0 * z[kCoreX] + x.c0 : x.a * z[kCoreX] + x.b * (*before)[kCoreX] + x.c;
  const double next_y = before == nullptr ? y.a0 * z[kCoreY] + y.c0 : y.a * z[kCoreY] + y.b * (*before)[kCoreY] + y.c;
  const bool inside = is_inside(next_x, next_y, prior_.width, prior_.height);
  if (goes_on) return inside ? log_go_inside_ : log_go_outside_;
  return inside ? log_die_inside_ : log_die_outside_;
}

CoreBelief CableLaw::belief(BaseKind kind, const CoreState* before2, const CoreState* before, const CoreState* after,
                            const CoreState* after2) const {
  CoreBelief belief;
  for (std::size_t k = 0, n = static_cast<std::size_t>(num_coordinates(kind)); k < n; ++k) {
    const Line& line = lines_[k];
    double precision = 0, weighted = 0;
    const auto take = [&](double mean, double weight) {
      precision += weight;
      weighted += weight * mean;
    };
    if (before == nullptr) {
      if (k == kCoreLogScale)
        take(prior_.log_scale.mean, 1 / (prior_.log_scale.deviation * prior_.log_scale.deviation));
      if (k == kCoreAmplitude)
        take(prior_.amplitude.mean, 1 / (prior_.amplitude.deviation * prior_.amplitude.deviation));
      if (after != nullptr && line.a0 != 0)
        take(((*after)[k] - line.c0) / line.a0, line.a0 * line.a0 * line.inverse0 * line.inverse0);
    } else {
      if (before2 == nullptr) take(line.a0 * (*before)[k] + line.c0, line.inverse0 * line.inverse0);
      if (before2 != nullptr)
        take(line.a * (*before)[k] + line.b * (*before2)[k] + line.c, line.inverse * line.inverse);
      if (after != nullptr && line.a != 0)
        take(((*after)[k] - line.b * (*before)[k] - line.c) / line.a, line.a * line.a * line.inverse * line.inverse);
    }
    if (after != nullptr && after2 != nullptr && line.b != 0)
      take(((*after2)[k] - line.a * (*after)[k] - line.c) / line.b, line.b * line.b * line.inverse * line.inverse);
    belief.precision[k] = precision;
    belief.mean[k] = precision > 0 ? weighted / precision : 0;
  }
  return belief;
}

}  // namespace motex
