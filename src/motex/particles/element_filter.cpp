// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/element_filter.h"

#include <algorithm>
#include <cmath>

namespace motex {
namespace {

constexpr double kLogTwoPi = 1.8378770664093453;
constexpr double kOutlierDistance = 12;  // squared deviations of a place beyond which a sight is an outlier
constexpr double kLevelOutlier = 9;

/// A normal density with bounded tails: beyond the limit the cost rises with the logarithm.
double bounded_square(double square, double limit) {
  return square <= limit ? square : limit * (1 + std::log(square / limit));
}

}  // namespace

void ElementFilter::advance(Axis& a, const AxisModel& model, int num_frames) {
  const double f = model.persistence;
  for (int k = 0; k < num_frames; ++k) {
    a.v = model.mean_velocity + f * (a.v - model.mean_velocity);
    a.p += a.v;
    const double vv = f * f * a.vv + model.step_variance, pv = f * a.pv;
    a.pp += 2 * pv + vv;
    a.pv = pv + vv;
    a.vv = vv;
  }
}

double ElementFilter::start(Level& level, const LevelModel& model, double value, double extra) {
  if (model.variance <= 0) return 0;
  const double total = model.variance + model.noise_variance + extra, gain = model.variance / total;
  const double off = value - model.mean;
  level.value = model.mean + gain * off;
  level.variance = model.variance * (1 - gain);
  return -0.5 * (kLogTwoPi + std::log(total) + bounded_square(off * off / total, kLevelOutlier));
}

double ElementFilter::follow(Level& level, const LevelModel& model, double value, double extra, int num_frames) {
  if (model.variance <= 0) return 0;
  level.variance += num_frames * model.step_variance;
  const double noise = model.noise_variance + extra, total = level.variance + noise;
  const double off = value - level.value, square = off * off / total;
  const double gain = level.variance / (level.variance + noise * std::max(1.0, square / kLevelOutlier));
  level.value += gain * off;
  level.variance *= 1 - gain;
  return -0.5 * (kLogTwoPi + std::log(total) + bounded_square(square, kLevelOutlier));
}

double ElementFilter::start(const Sight& sight) {
  frame_ = sight.frame;
  const auto begin = [&](Axis& axis, const AxisModel& model, double value) {
    axis = {value, model.mean_velocity, model.noise_variance + sight.place_variance, 0, model.start_variance};
  };
  begin(x_, model_->x, sight.x);
  begin(y_, model_->y, sight.y);
  return start(amplitude_, model_->log_amplitude, sight.log_amplitude, sight.log_amplitude_variance) +
         start(scale_, model_->log_scale, sight.log_scale, sight.log_scale_variance);
}

double ElementFilter::follow(Axis& a, const AxisModel& model, double value, double extra, double inflation) {
  const double noise = (model.noise_variance + extra) * inflation;
  const double total = a.pp + noise, off = value - a.p, kp = a.pp / total, kv = a.pv / total;
  a.p += kp * off;
  a.v += kv * off;
  a.vv -= kv * a.pv;
  a.pv *= 1 - kp;
  a.pp *= 1 - kp;
  return total;
}

double ElementFilter::follow(const Sight& sight) {
  const int num = sight.frame - frame_;
  advance(x_, model_->x, num);
  advance(y_, model_->y, num);
  frame_ = sight.frame;
  const double square = distance(sight);
  const double area = (x_.pp + model_->x.noise_variance + sight.place_variance) *
                      (y_.pp + model_->y.noise_variance + sight.place_variance);
  const double inflation = std::max(1.0, square / kOutlierDistance);
  follow(x_, model_->x, sight.x, sight.place_variance, inflation);
  follow(y_, model_->y, sight.y, sight.place_variance, inflation);
  return -kLogTwoPi - 0.5 * (std::log(area) + bounded_square(square, kOutlierDistance)) +
         follow(amplitude_, model_->log_amplitude, sight.log_amplitude, sight.log_amplitude_variance, num) +
         follow(scale_, model_->log_scale, sight.log_scale, sight.log_scale_variance, num);
}

ElementFilter ElementFilter::waited(int frame) const {
  ElementFilter out = *this;
  const int num = frame - frame_;
  advance(out.x_, model_->x, num);
  advance(out.y_, model_->y, num);
  out.amplitude_.variance += num * model_->log_amplitude.step_variance;
  out.scale_.variance += num * model_->log_scale.step_variance;
  out.frame_ = frame;
  return out;
}

double ElementFilter::distance(const Sight& sight) const {
  Axis x = x_, y = y_;
  advance(x, model_->x, sight.frame - frame_);
  advance(y, model_->y, sight.frame - frame_);
  const double dx = sight.x - x.p, dy = sight.y - y.p;
  return dx * dx / (x.pp + model_->x.noise_variance + sight.place_variance) +
         dy * dy / (y.pp + model_->y.noise_variance + sight.place_variance);
}

double ElementFilter::expected_x(int frame) const {
  Axis axis = x_;
  advance(axis, model_->x, frame - frame_);
  return axis.p;
}

double ElementFilter::variance_x(int frame) const {
  Axis axis = x_;
  advance(axis, model_->x, frame - frame_);
  return axis.pp + model_->x.noise_variance;
}

double ElementFilter::variance_y(int frame) const {
  Axis axis = y_;
  advance(axis, model_->y, frame - frame_);
  return axis.pp + model_->y.noise_variance;
}

double ElementFilter::expected_y(int frame) const {
  Axis axis = y_;
  advance(axis, model_->y, frame - frame_);
  return axis.p;
}

namespace {

/// Place and velocity with their covariance at one frame.
struct AxisState {
  double p = 0, v = 0, pp = 0, pv = 0, vv = 0;
  double noise = -1;  // variance with which the sight of this frame was taken in; −1 = none
};

AxisState ahead(const AxisState& a, const AxisModel& model) {
  const double f = model.persistence;
  AxisState b;
  b.v = model.mean_velocity + f * (a.v - model.mean_velocity);
  b.p = a.p + b.v;
  b.vv = f * f * a.vv + model.step_variance;
  b.pp = a.pp + 2 * f * a.pv + b.vv;
  b.pv = f * a.pv + b.vv;
  return b;
}

/// Forward filter over the frames, then Rauch–Tung–Striebel. values: by frame; variance < 0 = not seen there.
std::vector<AxisState> smooth_axis(const AxisModel& model, const std::vector<double>& values,
                                   const std::vector<double>& variances, std::size_t first_seen) {
  const std::size_t num = values.size();
  std::vector<AxisState> predicted(num), filtered(num);
  // Before the first sight the element is unknown: a wide place around where it was seen.
  for (std::size_t t = 0; t < num; ++t) {
    if (t == 0) {
      const double away = static_cast<double>(first_seen);
      predicted[t] = {values[first_seen] - away * model.mean_velocity, model.mean_velocity,
                      1e4 + 100 * away * away * model.start_variance, 0, model.start_variance};
    } else {
      predicted[t] = ahead(filtered[t - 1], model);
    }
    filtered[t] = predicted[t];
    if (variances[t] < 0) continue;
    AxisState& a = filtered[t];
    const double off = values[t] - a.p;
    const double square = off * off / (a.pp + variances[t]);
    const double noise = variances[t] * std::max(1.0, square / kOutlierDistance);
    a.noise = noise;
    const double kp = a.pp / (a.pp + noise), kv = a.pv / (a.pp + noise);
    a.p += kp * off;
    a.v += kv * off;
    a.vv -= kv * a.pv;
    a.pv *= 1 - kp;
    a.pp *= 1 - kp;
  }
  std::vector<AxisState> out = filtered;
  for (std::size_t t = num - 1; t-- > 0;) {
    const AxisState &f = filtered[t], &next = predicted[t + 1], &smooth = out[t + 1];
    // C = P Fᵀ P'⁻¹ with F = (1 φ; 0 φ)
    const double phi = model.persistence, det = std::max(1e-12, next.pp * next.vv - next.pv * next.pv);
    const double c00 = f.pp + phi * f.pv, c01 = phi * f.pv, c10 = f.pv + phi * f.vv, c11 = phi * f.vv;
    const double g00 = (c00 * next.vv - c01 * next.pv) / det, g01 = (c01 * next.pp - c00 * next.pv) / det;
    const double g10 = (c10 * next.vv - c11 * next.pv) / det, g11 = (c11 * next.pp - c10 * next.pv) / det;
    const double dp = smooth.p - next.p, dv = smooth.v - next.v;
    const double epp = smooth.pp - next.pp, epv = smooth.pv - next.pv, evv = smooth.vv - next.vv;
    out[t].p = f.p + g00 * dp + g01 * dv;
    out[t].v = f.v + g10 * dp + g11 * dv;
    out[t].pp = f.pp + g00 * (g00 * epp + g01 * epv) + g01 * (g00 * epv + g01 * evv);
    out[t].pv = f.pv + g10 * (g00 * epp + g01 * epv) + g11 * (g00 * epv + g01 * evv);
    out[t].vv = f.vv + g10 * (g10 * epp + g11 * epv) + g11 * (g10 * epv + g11 * evv);
  }
  return out;
}

/// The place without the sight of its own frame: precisions subtract.
void without_own(const AxisState& a, double seen, double& place, double& variance) {
  place = a.p;
  variance = a.pp;
  if (a.noise <= 0) return;
  const double precision = 1 / std::max(a.pp, 1e-12) - 1 / a.noise;
  if (precision < 1e-4) {
    variance = 1e4;
    return;
  }
  place = (a.p / std::max(a.pp, 1e-12) - seen / a.noise) / precision;
  variance = 1 / precision;
}

}  // namespace

std::vector<SmoothedPlace> smooth_path(const ElementModel& model, const std::vector<Sight>& sights, int num_before,
                                       int num_after) {
  if (sights.empty()) return {};
  const int first = sights.front().frame - num_before, num = sights.back().frame + num_after - first + 1;
  const auto size = static_cast<std::size_t>(num);
  std::vector<double> x(size), y(size), variance_x(size, -1.0), variance_y(size, -1.0);
  for (const Sight& sight : sights) {
    const auto t = static_cast<std::size_t>(sight.frame - first);
    x[t] = sight.x;
    y[t] = sight.y;
    variance_x[t] = model.x.noise_variance + sight.place_variance;
    variance_y[t] = model.y.noise_variance + sight.place_variance;
  }
  const auto seen = static_cast<std::size_t>(num_before);
  const std::vector<AxisState> sx = smooth_axis(model.x, x, variance_x, seen),
                               sy = smooth_axis(model.y, y, variance_y, seen);
  std::vector<SmoothedPlace> out(size);
  for (std::size_t t = 0; t < size; ++t) {
    SmoothedPlace& place = out[t];
    place = {sx[t].p, sy[t].p, sx[t].v, sy[t].v, std::max(0.0, sx[t].pp), std::max(0.0, sy[t].pp), 0, 0, 0, 0};
    without_own(sx[t], x[t], place.others_x, place.others_variance_x);
    without_own(sy[t], y[t], place.others_y, place.others_variance_y);
  }
  return out;
}

}  // namespace motex
