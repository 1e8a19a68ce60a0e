// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// The move that changes a whole cable's scale and amplitude: where both hardly vary along a cable, single cores cannot.
#include <cmath>
#include <limits>

#include "motex/particles/cable_moves.h"

namespace motex {
namespace {

constexpr double kWidening = 1.1;

}  // namespace

/// Normal proposal of the change of (ln scale, amplitude): one Newton step, and its precision.
struct CableMoves::LevelStep {
  double mean_s, mean_a, ss, sa, aa;

  double log_density(double ds, double da) const {
    const double u = ds - mean_s, v = da - mean_a;
    return 0.5 * std::log(ss * aa - sa * sa) -
           0.5 * (ss * u * u + 2 * sa * u * v + aa * v * v) / (kWidening * kWidening);
  }
};

CableMoves::LevelStep CableMoves::level_step(BaseKind kind, int frame, std::span<const CoreState> states) const {
  const CablePrior& prior = law_.prior();
  const double weight_s = 1 / (prior.log_scale.deviation * prior.log_scale.deviation),
               weight_a = 1 / (prior.amplitude.deviation * prior.amplitude.deviation);
  double slope_s = weight_s * (prior.log_scale.mean - states[0][kCoreLogScale]),
         slope_a = weight_a * (prior.amplitude.mean - states[0][kCoreAmplitude]);
  LevelStep step{0, 0, weight_s, 0, weight_a};
  for (std::size_t k = 0; k < states.size(); ++k) {
    const CoreLinearisation line = linearise_core(state_.image(frame + static_cast<int>(k)), kind, states[k]);
    slope_s += 2 * image_weight_ * line.slope[kCoreLogScale];
    slope_a += 2 * image_weight_ * line.slope[kCoreAmplitude];
    step.ss += 2 * image_weight_ * line.curvature[kCoreLogScale][kCoreLogScale];
    step.sa += 2 * image_weight_ * line.curvature[kCoreLogScale][kCoreAmplitude];
    step.aa += 2 * image_weight_ * line.curvature[kCoreAmplitude][kCoreAmplitude];
  }
  const double determinant = step.ss * step.aa - step.sa * step.sa;
  step.mean_s = (step.aa * slope_s - step.sa * slope_a) / determinant;
  step.mean_a = (step.ss * slope_a - step.sa * slope_s) / determinant;
  return step;
}

void CableMoves::level(int frame) {
  int idx = pick(frame), first = frame;
  if (idx < 0) return;
  for (; state_.element(first, idx).previous >= 0; --first) {
    if (!range_.holds(first - 1)) return;
    idx = state_.element(first, idx).previous;
  }
  const BaseKind kind = state_.element(first, idx).kind;
  track_.clear();
  track_states_.clear();
  for (int t = first; idx >= 0; ++t) {
    if (!range_.holds(t)) return;
    track_.push_back(idx);
    track_states_.push_back(state_.element(t, idx).z);
    idx = state_.element(t, idx).next;
  }
  show(first, track_, 1);
  const LevelStep there = level_step(kind, first, track_states_);
  const double n1 = kWidening * rng_.normal(), n2 = kWidening * rng_.normal();
  const double root = std::sqrt(there.ss), schur = std::sqrt(there.aa - there.sa * there.sa / there.ss);
  const double da_noise = n2 / schur, ds_noise = n1 / root - there.sa / there.ss * da_noise;
  const double ds = there.mean_s + ds_noise, da = there.mean_a + da_noise;
  moved_states_ = track_states_;
  for (CoreState& z : moved_states_) {
    z[kCoreLogScale] += ds;
    z[kCoreAmplitude] += da;
  }
  double change = -std::numeric_limits<double>::infinity(), log_hastings = 0;
  if (are_possible(kind, moved_states_)) {
    log_hastings = level_step(kind, first, moved_states_).log_density(-ds, -da) - there.log_density(ds, da);
    change = log_of_track(kind, first, moved_states_) - log_of_track(kind, first, track_states_);
  }
  if (accept(CableJump::kLevel, change, log_hastings))
    for (std::size_t k = 0; k < track_.size(); ++k)
      state_.place(first + static_cast<int>(k), track_[k], moved_states_[k]);
  show(first, track_, -1);
}

/// Terms that depend on the levels: image, birth, and steps (a walk around a mean is not indifferent to a shift).
double CableMoves::log_of_track(BaseKind kind, int frame, std::span<const CoreState> z) const {
  double sum = law_.log_birth(z[0], frame);
  for (std::size_t k = 0; k < z.size(); ++k) {
    if (k == 1) sum += law_.log_first_step(kind, z[0], z[1]);
    if (k >= 2) sum += law_.log_step(kind, z[k - 2], z[k - 1], z[k]);
    sum += explained(frame + static_cast<int>(k), kind, z[k]);
  }
  return sum;
}

}  // namespace motex
