// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/element.h"

#include <algorithm>
#include <cmath>

#include "motex/particles/cable_tracks.h"

namespace motex {
namespace {

double reach_of_bases(const Base& core, std::span<const Base> bases) {
  double reach = 0;
  for (const Base& base : bases) {
    const BaseReach own = reach_of(base);
    reach = std::max(reach, std::hypot(base.x - core.x, base.y - core.y) + std::max(own.x, own.y));
  }
  return reach;
}

void fade(Base& base, double strength) {
  for (float& coefficient : base.coefficients) coefficient *= static_cast<float>(strength);
}

}  // namespace

double draw_constant_like(const CoordinateDynamics& law, std::span<const double> values, bool is_place, Rng& rng) {
  double start = law.start_mean;
  if (is_place && values.size() > 1) start = values[1] - values[0];
  if (!is_place && !values.empty()) start = values[0];
  const double explained = law.c_slope * law.start_deviation;
  const double prior_variance = std::max(0.0, law.c_spread * law.c_spread - explained * explained);
  const double prior_mean = law.c + law.c_slope * (start - law.start_mean);
  double sum = 0;
  const auto num_steps = static_cast<double>(values.size() < 3 ? 0 : values.size() - 2);
  for (std::size_t t = 2; t < values.size(); ++t) sum += values[t] - law.a * values[t - 1] - law.b * values[t - 2];
  if (prior_variance <= 0) return prior_mean;
  if (law.d <= 0) return num_steps > 0 ? sum / num_steps : prior_mean;
  const double precision = 1 / prior_variance + num_steps / (law.d * law.d);
  const double mean = (prior_mean / prior_variance + sum / (law.d * law.d)) / precision;
  return mean + rng.normal() / std::sqrt(precision);
}

ElementLooks ElementLooks::replay(const Cable& cable) {
  ElementLooks looks;
  looks.cable_ = &cable;
  const std::size_t middle = cable.core.size() / 2;
  std::vector<Base> bases{cable.core[middle]};
  for (const std::vector<Base>& coil : cable.coils) bases.push_back(coil[middle]);
  looks.reach_ = reach_of_bases(bases[0], bases);
  return looks;
}

ElementLooks ElementLooks::sampled(const MovetonTemplate& of, int num_planes, Rng& rng) {
  ElementLooks looks;
  looks.moveton_.emplace(of, num_planes, rng);
  Base core;
  core.kind = looks.moveton_->core_kind();
  core.scale = std::exp(of.log_scale.mean);
  looks.moveton_->colour_core(core, 1);
  std::vector<Base> bases{core};
  looks.moveton_->append_coils(core, bases);
  looks.reach_ = reach_of_bases(core, bases);
  return looks;
}

std::size_t ElementLooks::frame_at(std::int64_t age) const {
  const auto last = static_cast<std::int64_t>(cable_->core.size()) - 1;
  if (last <= 0) return 0;
  const std::int64_t place = std::abs(age) % (2 * last);
  return static_cast<std::size_t>(place <= last ? place : 2 * last - place);
}

int ElementLooks::pose(std::int64_t age) const {
  if (moveton_) return moveton_->pose();
  return cable_ == nullptr || cable_->poses.empty() ? 0 : cable_->poses[frame_at(age)];
}

void ElementLooks::append(double x, double y, double scale, double angle, double amplitude, std::int64_t age,
                          double strength, std::vector<Base>& bases) const {
  const std::size_t first = bases.size();
  if (moveton_) {
    Base core;
    core.kind = moveton_->core_kind();
    core.x = x;
    core.y = y;
    core.scale = scale;
    core.angle = angle;
    moveton_->colour_core(core, coefficient_of_peak(core, amplitude));
    bases.push_back(core);
    moveton_->append_coils(core, bases);
  } else if (cable_ != nullptr) {
    const std::size_t frame = frame_at(age);
    const Base& core = cable_->core[frame];
    const auto append_moved = [&](const Base& base) {
      bases.push_back(base);
      bases.back().x += x - core.x;
      bases.back().y += y - core.y;
    };
    append_moved(core);
    for (const std::vector<Base>& coil : cable_->coils) append_moved(coil[frame]);
  }
  if (strength < 1)
    for (std::size_t k = first; k < bases.size(); ++k) fade(bases[k], strength);
}

double Element::strength() const {
  double strength = 1;
  if (fades_in) strength = std::min(strength, static_cast<double>(age + 1) / static_cast<double>(kFadeFrames + 1));
  if (fading >= 0)
    strength = std::min(strength, static_cast<double>(kFadeFrames - fading) / static_cast<double>(kFadeFrames + 1));
  return std::max(strength, 0.0);
}

}  // namespace motex
