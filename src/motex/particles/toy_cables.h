// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "motex/core/rng.h"
#include "motex/particles/core_proposal.h"

/// For tests of the moves over cables: three frames of 24 × 8 pixels with one spot that goes right, a prior, and a
/// proposal that knows three places only.
namespace motex {

constexpr int kToyFrames = 3;
constexpr double kPlaces[] = {8, 11, 14};  // x; one cell
constexpr int kNumPlaces = 3;

inline CoreState place(int idx) { return {kPlaces[idx], 4, std::log(1.5), 60, 0}; }

/// Masses over the places, from the image and the belief, but blunted: so acceptance must make up for it.
class PlacesProposal : public CoreProposal {
 public:
  explicit PlacesProposal(const CablePrior& prior) : prior_(prior) {}

  void look_around(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief) override {
    weigh(image, kind, belief, [](const CoreState&) { return true; });
  }
  bool look_in_cell(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief,
                    const PictureCell& cell) override {
    return weigh(image, kind, belief,
                 [&](const CoreState& z) { return z[kCoreX] >= cell.left && z[kCoreX] < cell.left + cell.width; });
  }
  void look_near(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief, double, double, double) override {
    look_around(image, kind, belief);
  }
  CoreState best() const override {
    return place(static_cast<int>(std::max_element(masses_.begin(), masses_.end()) - masses_.begin()));
  }
  CoreState draw(Rng& rng) const override { return place(static_cast<int>(rng.weighted(masses_))); }
  double log_density(const CoreState& state) const override {
    for (int i = 0; i < kNumPlaces; ++i)
      if (state[kCoreX] == kPlaces[i]) return std::log(masses_[static_cast<std::size_t>(i)]);
    return -1e300;
  }
  CoreState step(BaseKind, const CoreState& state, Rng& rng) const override {
    const int move = rng.below(2) == 0 ? -1 : 1;
    for (int i = 0; i < kNumPlaces; ++i)
      if (state[kCoreX] == kPlaces[i]) return i + move < 0 || i + move >= kNumPlaces ? state : place(i + move);
    return state;
  }

 private:
  template <typename Allowed>
  bool weigh(const ResidualFrame& image, BaseKind kind, const CoreBelief& belief, Allowed&& allowed) {
    double total = 0;
    for (int i = 0; i < kNumPlaces; ++i) {
      const CoreState z = place(i);
      const double gain = explained_by(image, kind, z) / (4 * prior_.noise * prior_.noise);
      const double u = z[kCoreX] - belief.mean[kCoreX];
      const double mass = allowed(z) ? 0.1 + std::exp(gain - 0.2 * belief.precision[kCoreX] * u * u) : 0;
      masses_[static_cast<std::size_t>(i)] = mass;
      total += mass;
    }
    for (double& mass : masses_) mass /= std::max(total, 1e-300);
    return total > 0;
  }

  const CablePrior& prior_;
  std::array<double, kNumPlaces> masses_{};
};

/// Crowded: two elements a frame nearly always, cables long; else few, so that a factor of two in either direction
/// tells.
inline CablePrior toy_prior(bool is_crowded = true) {
  CablePrior prior;
  prior.width = 24;
  prior.height = 8;
  prior.noise = 80;
  prior.min_coefficient = 1;
  prior.density_first = is_crowded ? 8 : 0.8;
  prior.births_inside = is_crowded ? 5 : 0.5;
  prior.births_edge = is_crowded ? 4 : 0.4;
  prior.death_inside = 0.35;
  prior.death_outside = 0.8;
  prior.log_scale = {std::log(1.5), 0.5};
  prior.amplitude = {60, 0.5};
  CoordinateDynamics& x = prior.dynamics.x;
  x.a = 1.6;
  x.b = -0.6;
  x.c = 0.4;
  x.d = 3;
  x.c0 = 1;
  x.d0 = 4;
  for (CoordinateDynamics* still : {&prior.dynamics.y, &prior.dynamics.log_scale, &prior.dynamics.amplitude}) {
    still->d = still->d0 = is_crowded ? 0.12 : 0.3;
    still->c = still->c0 = 0;
  }
  prior.max_per_frame = 2;
  return prior;
}

inline std::vector<Plane> toy_pictures() {
  std::vector<Plane> pictures(kToyFrames, Plane(24, 8));
  Rng rng(5);
  for (Plane& picture : pictures)
    for (float& value : picture.values) value = static_cast<float>(20 * rng.normal());
  for (int t = 0; t < kToyFrames; ++t)
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 24; ++x)
        pictures[static_cast<std::size_t>(t)].at(x, y) +=
            static_cast<float>(50 * std::exp(-((x - 9 - t) * (x - 9 - t) + (y - 4) * (y - 4)) / 4.5));
  return pictures;
}

}  // namespace motex
