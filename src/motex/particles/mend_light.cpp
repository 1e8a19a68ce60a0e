// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/mend_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motex/core/parallel.h"
#include "motex/particles/base.h"

namespace motex {
namespace {

constexpr int kSweeps = 20;
constexpr float kLeastShare = 0.02F;   // of an amplitude: none of 0, which is no element
constexpr double kLeastEnergy = 0.01;  // of a patch of unit norm: less of it lies in the picture
constexpr double kLeastCoefficient = 1e-6;

/// A core in the frame at hand.
struct Light {
  Base* core;
  BasePatch patch;
  double energy;
  float before;  ///< its coefficient
};

/// One coefficient after the other to what the others leave.
void fit_in_turn(Plane& left, std::vector<Light>& lights) {
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (Light& light : lights) {
      if (light.energy < kLeastEnergy || std::abs(light.before) < kLeastCoefficient) continue;
      float& now = light.core->coefficients[0];
      const float wanted = now + inner_product(light.patch, left) / static_cast<float>(light.energy);
      const float share = std::max(wanted / light.before, kLeastShare);
      add_patch(left, light.patch, now - share * light.before);
      now = share * light.before;
    }
}

}  // namespace

void mend_light(const std::vector<Plane>& residuals, std::vector<Cable>& cables, int jobs) {
  parallel_for(jobs, static_cast<int>(residuals.size()), [&](int frame) {
    const Plane& residual = residuals[static_cast<std::size_t>(frame)];
    Plane left = residual;
    std::vector<Light> lights;
    for (Cable& cable : cables) {
      if (!cable.covers(frame)) continue;
      Base& core = cable.core[static_cast<std::size_t>(frame - cable.first_frame)];
      BasePatch patch = render_patch(core, left.width, left.height);
      const double energy = energy_of(patch);
      add_patch(left, patch, -core.coefficients[0]);
      lights.push_back({&core, std::move(patch), energy, core.coefficients[0]});
    }
    if (sum_of_squares(left) > sum_of_squares(residual)) fit_in_turn(left, lights);
  });
}

}  // namespace motex
