// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/element.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "motex/particles/cable_tracks.h"

namespace motex {
namespace {

constexpr double kWellInside = 1.5;  // core scales from the border

constexpr std::array<double, 9> kFreedoms{1e4, 100, 30, 15, 8, 5, 3, 2, 1};
constexpr std::array<double, 8> kTypicalShares{1, 0.85, 0.7, 0.5, 0.35, 0.2, 0.1, 0.03};

constexpr double kFewPairs = 50;  // residuals that tell nothing of correlation

/// c_i given the cable: normal.
struct ConstantBelief {
  double mean = 0, deviation = 0;
};

ConstantBelief constant_of(const CoordinateDynamics& law, std::span<const double> values, bool is_place) {
  double start = law.start_mean;
  if (is_place && values.size() > 1) start = values[1] - values[0];
  if (!is_place && !values.empty()) start = values[0];
  const double explained = law.c_slope * law.start_deviation;
  const double prior_variance = std::max(0.0, law.c_spread * law.c_spread - explained * explained);
  const double prior_mean = law.c + law.c_slope * (start - law.start_mean);
  double sum = 0;
  const auto num_steps = static_cast<double>(values.size() < 3 ? 0 : values.size() - 2);
  for (std::size_t t = 2; t < values.size(); ++t) sum += values[t] - law.a * values[t - 1] - law.b * values[t - 2];
  if (prior_variance <= 0) return {prior_mean, 0};
  if (law.d <= 0) return {num_steps > 0 ? sum / num_steps : prior_mean, 0};
  const double precision = 1 / prior_variance + num_steps / (law.d * law.d);
  return {(prior_mean / prior_variance + sum / (law.d * law.d)) / precision, 1 / std::sqrt(precision)};
}

struct Residuals {
  double num = 0, squares = 0;
  double products = 0, paired_squares = 0;  // of one with the next
};

Residuals residuals_of(const CoordinateDynamics& law, std::span<const double> values) {
  const double constant = constant_of(law, values, true).mean;
  Residuals out;
  double last = 0;
  for (std::size_t t = 2; t < values.size(); ++t) {
    const double rest = values[t] - law.a * values[t - 1] - law.b * values[t - 2] - constant;
    out.squares += rest * rest;
    if (out.num > 0) {
      out.products += rest * last;
      out.paired_squares += (rest * rest + last * last) / 2;
    }
    last = rest;
    out.num += 1;
  }
  return out;
}

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
  const ConstantBelief belief = constant_of(law, values, is_place);
  return belief.deviation > 0 ? belief.mean + belief.deviation * rng.normal() : belief.mean;
}

NoiseSpread learn_noise_spread(const CoordinateDynamics& law, const std::vector<std::vector<double>>& places) {
  std::vector<Residuals> all;
  for (const std::vector<double>& values : places)
    if (values.size() > 2) all.push_back(residuals_of(law, values));
  NoiseSpread best{law.d, kFreedoms[0], 0};
  if (all.empty() || law.d <= 0) return best;
  double products = 0, squares = 0;
  for (const Residuals& own : all) {
    products += own.products / std::max(1e-300, own.squares / own.num);
    squares += own.paired_squares / std::max(1e-300, own.squares / own.num);
  }
  double highest = -std::numeric_limits<double>::infinity();
  for (const double freedom : kFreedoms)
    for (const double share : kTypicalShares) {
      const double square = share * law.d * law.d, half = freedom / 2;
      double score = 0;
      for (const Residuals& own : all)
        score += std::lgamma(half + own.num / 2) - std::lgamma(half) + half * std::log(freedom * square) -
                 (half + own.num / 2) * std::log(freedom * square + own.squares);
      if (score <= highest) continue;
      highest = score;
      best = {std::sqrt(square), freedom, 0};
    }
  if (squares >= kFewPairs) best.correlation = products / squares;
  return best;
}

double noise_like(const NoiseSpread& spread, const CoordinateDynamics& law, std::span<const double> values) {
  if (values.size() < 3) return spread.typical;
  const Residuals own = residuals_of(law, values);
  return std::sqrt((spread.freedom * spread.typical * spread.typical + own.squares) / (spread.freedom + own.num));
}

ElementLooks ElementLooks::replay(const Cable& cable, int width, int height) {
  ElementLooks looks;
  looks.cable_ = &cable;
  const auto depth = [width, height](const Base& base) {  // inside the picture, in scales
    return std::min({base.x, base.y, width - 1 - base.x, height - 1 - base.y}) / base.scale;
  };
  std::size_t first = 0, longest = 0;
  for (std::size_t k = 0; k <= cable.core.size(); ++k) {
    if (k < cable.core.size() && depth(cable.core[k]) >= kWellInside) continue;
    if (k - first > longest) {
      longest = k - first;
      looks.first_ = first;
      looks.last_ = k - 1;
    }
    first = k + 1;
  }
  if (longest == 0) {
    const auto deepest = std::max_element(cable.core.begin(), cable.core.end(),
                                          [&](const Base& a, const Base& b) { return depth(a) < depth(b); });
    looks.first_ = looks.last_ = static_cast<std::size_t>(deepest - cable.core.begin());
  }
  const std::size_t middle = (looks.first_ + looks.last_) / 2;
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
  const auto num_steps = static_cast<std::int64_t>(last_ - first_);
  if (num_steps == 0) return first_;
  const std::int64_t place = std::abs(age) % (2 * num_steps);
  return first_ + static_cast<std::size_t>(place <= num_steps ? place : 2 * num_steps - place);
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
