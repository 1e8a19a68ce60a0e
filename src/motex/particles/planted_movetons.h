// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "motex/core/rng.h"
#include "motex/particles/cable.h"
#include "motex/particles/clip_frames.h"

namespace motex {

/// A clip made of known movetons, for tests: dark bodies with two wings that are up, level or down (or without wings),
/// on an even background with noise.
struct PlantedMovetons {
  ClipFrames clip;
  Planes background;
  std::vector<Cable> cables;             ///< as they are drawn: core, coils, poses
  std::vector<std::vector<int>> states;  ///< of each cable
};

constexpr double kFlap[3][3] = {{0.6, 0.4, 0}, {0.3, 0.2, 0.5}, {0, 0.4, 0.6}};

inline Base planted_base(BaseKind kind, double x, double y, double scale, double angle, double peak) {
  Base base{kind, x, y, scale, angle, {}};
  base.coefficients[0] = static_cast<float>(coefficient_of_peak(base, peak));
  return base;
}

/// num_birds rows of birds that fly to the right, each in its own lane; `winged` of them have wings.
inline PlantedMovetons plant_movetons(int num_birds, int winged, int num_frames, double noise, std::uint64_t seed) {
  Rng rng(seed);
  PlantedMovetons out;
  const int columns = 2, lanes = (num_birds + columns - 1) / columns;
  out.clip.width = 220;
  out.clip.height = 30 * lanes;
  out.background = {Plane(out.clip.width, out.clip.height, 150)};
  out.clip.luma.assign(static_cast<std::size_t>(num_frames), out.background[0]);
  for (int bird = 0; bird < num_birds; ++bird) {
    Cable cable;
    if (bird < winged) cable.coils.resize(2);
    std::vector<int> states;
    int state = static_cast<int>(rng.below(3));
    const double scale = rng.uniform(1.8, 2.6), peak = -rng.uniform(60, 90);
    for (int t = 0; t < num_frames; ++t) {
      const int row = bird / columns;
      const double x = 18 + 110 * (bird % columns) + 70.0 * t / num_frames, y = 15.3 + 30 * row;
      cable.core.push_back(planted_base(BaseKind::kGaussian, x, y, scale, 0, peak));
      const double lift = state == 0 ? -1.6 : state == 1 ? 0 : 1.6;
      for (std::size_t side = 0; side < cable.coils.size(); ++side) {
        const double way = side == 0 ? -1 : 1;
        cable.coils[side].push_back(
            planted_base(BaseKind::kGaussian, x + way * 2 * scale, y + lift * scale, 0.8 * scale, 0, 0.6 * peak));
      }
      states.push_back(state);
      const double next = rng.uniform();
      state = next < kFlap[state][0] ? 0 : next < kFlap[state][0] + kFlap[state][1] ? 1 : 2;
    }
    for (int t = 0; t < num_frames; ++t) {
      const auto at = static_cast<std::size_t>(t);
      std::vector<Base> bases{cable.core[at]};
      for (const std::vector<Base>& coil : cable.coils) bases.push_back(coil[at]);
      for (const Base& base : bases)
        add_patch(out.clip.luma[at], render_patch(base, out.clip.width, out.clip.height), base.coefficients[0]);
    }
    out.cables.push_back(std::move(cable));
    out.states.push_back(std::move(states));
  }
  for (Plane& plane : out.clip.luma)
    for (float& value : plane.values) value += static_cast<float>(noise * rng.normal());
  return out;
}

/// The cores alone, coefficients unknown: what the tracker gives.
inline std::vector<Cable> cores_of(const std::vector<Cable>& cables) {
  std::vector<Cable> out = cables;
  for (Cable& cable : out) {
    cable.coils.clear();
    for (Base& core : cable.core) core.coefficients.fill(-1);
  }
  return out;
}

}  // namespace motex
