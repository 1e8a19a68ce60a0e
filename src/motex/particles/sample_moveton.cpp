// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/sample_moveton.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/particles/coil_search.h"
#include "motex/particles/coils.h"

namespace motex {
namespace {

constexpr double kMostDeviations = 2;

double drawn(const Spread& spread, Rng& rng) {
  return spread.mean + spread.deviation * std::clamp(rng.normal(), -kMostDeviations, kMostDeviations);
}

/// A factor of a mean: neither the sign changes nor does it vanish or explode.
double drawn_factor(const Spread& spread, Rng& rng) {
  const double deviation = spread.mean != 0 ? spread.deviation / std::abs(spread.mean) : 0;
  return std::clamp(1 + deviation * rng.normal(), 0.25, 2.0);
}

/// One factor for all colours: they vary together.
RelativeBase drawn(const TemplateCoil& coil, Rng& rng) {
  RelativeBase out{
      coil.kind, drawn(coil.u, rng), drawn(coil.v, rng), drawn(coil.log_scale, rng), drawn(coil.angle, rng), {}};
  Spread strongest;
  for (const Spread& spread : coil.coefficient)
    if (std::abs(spread.mean) > std::abs(strongest.mean)) strongest = spread;
  const double factor = drawn_factor(strongest, rng);
  for (std::size_t k = 0; k < 3; ++k) out.coefficient[k] = coil.coefficient[k].mean * factor;
  return out;
}

}  // namespace

SampledMoveton::SampledMoveton(const MovetonTemplate& moveton_template, int num_planes, Rng& rng)
    : template_(&moveton_template), num_planes_(num_planes) {
  if (moveton_template.poses.empty()) throw InvalidInput("a template needs at least one pose");
  std::vector<double> shares;
  for (const TemplatePose& pose : moveton_template.poses) {
    shares.push_back(std::max(1e-9, pose.share));
    std::vector<RelativeBase> coils;
    for (const TemplateCoil& coil : pose.coils) {
      const bool is_there = rng.uniform() < coil.presence;
      const RelativeBase base = drawn(coil, rng);
      if (is_there) coils.push_back(base);
    }
    num_coils_ = std::max(num_coils_, static_cast<int>(coils.size()));
    coils_.push_back(std::move(coils));
  }
  pose_ = static_cast<int>(rng.weighted(shares));
  const double amount = std::clamp(rng.normal(), -kMostDeviations, kMostDeviations);
  for (std::size_t k = 0; k < 3; ++k)
    colour_[k] = moveton_template.colour[k].mean + moveton_template.colour[k].deviation * amount;
}

void SampledMoveton::advance(Rng& rng) {
  const TransitionMatrix& transitions = template_->pose_transitions;
  const auto num = static_cast<int>(coils_.size());
  if (num < 2 || transitions.num_states() != num || transitions.is_dead_end(pose_)) return;
  double left = rng.uniform();
  for (int to = 0; to < num; ++to) {
    left -= transitions.probability(pose_, to);
    if (left > 0 && to + 1 < num) continue;
    pose_ = to;
    return;
  }
}

BaseKind SampledMoveton::core_kind() const { return template_->poses[static_cast<std::size_t>(pose_)].core_kind; }

void SampledMoveton::append_coils(const Base& core, std::vector<Base>& out) const {
  const std::vector<RelativeBase>& coils = coils_[static_cast<std::size_t>(pose_)];
  for (const RelativeBase& coil : coils) out.push_back(placed_at(coil, core, num_planes_));
  for (auto j = static_cast<int>(coils.size()); j < num_coils_; ++j)
    out.push_back({BaseKind::kGaussian, core.x, core.y, core.scale, 0, {}});
}

void SampledMoveton::colour_core(Base& core, double luma_coefficient) const {
  core.coefficients.fill(0);
  if (num_planes_ < 3) {
    core.coefficients[0] = static_cast<float>(luma_coefficient);
    return;
  }
  const double luma = luma_of(colour_[0], colour_[1], colour_[2]);
  for (std::size_t k = 0; k < 3; ++k)  // a template without colours is grey
    core.coefficients[k] = static_cast<float>(luma_coefficient * (luma > 0.1 ? colour_[k] / luma : 1));
}

std::vector<Base> sample_moveton(const MovetonTemplate& moveton_template, int num_planes, double x, double y,
                                 Rng& rng) {
  const SampledMoveton moveton(moveton_template, num_planes, rng);
  Base core{moveton.core_kind(), x, y, std::exp(drawn(moveton_template.log_scale, rng)), 0, {}};
  if (is_oriented(core.kind)) core.angle = drawn(moveton_template.angle, rng);
  const double amplitude = moveton_template.amplitude.mean * drawn_factor(moveton_template.amplitude, rng);
  moveton.colour_core(core, coefficient_of_peak(core, amplitude));
  std::vector<Base> out{core};
  moveton.append_coils(core, out);
  return out;
}

void dress_cable(Cable& cable, const MovetonTemplate& moveton_template, int num_planes, Rng& rng) {
  SampledMoveton moveton(moveton_template, num_planes, rng);
  const std::size_t num = cable.core.size();
  cable.coils.assign(static_cast<std::size_t>(moveton.num_coils()), std::vector<Base>(num));
  cable.poses.clear();
  std::vector<Base> coils;
  for (std::size_t at = 0; at < num; ++at) {
    Base& core = cable.core[at];
    core.kind = moveton.core_kind();
    moveton.colour_core(core, static_cast<double>(core.coefficients[0]));
    coils.clear();
    moveton.append_coils(core, coils);
    for (std::size_t j = 0; j < coils.size(); ++j) cable.coils[j][at] = coils[j];
    if (moveton_template.poses.size() > 1) cable.poses.push_back(moveton.pose());
    moveton.advance(rng);
  }
}

}  // namespace motex
