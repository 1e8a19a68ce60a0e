// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "motex/particles/background.h"
#include "motex/particles/birth_death.h"
#include "motex/particles/cable.h"
#include "motex/particles/moveton_dynamics.h"
#include "motex/particles/moveton_template.h"
#include "motex/particles/water_model.h"

namespace motex {

/// How many elements cross a frame and how they flow together, found before anything is tracked.
struct SharedFlow {
  double vx = 0, vy = 0;  ///< pixels a frame
  double peak_ratio = 0;  ///< peak / median of the histogram of displacements: below 20 there is no shared flow
};

/// A learned model Θ = (Ψ, Γ) of [TM02] with the hidden variables W it was learned with: everything that synthesis,
/// editing, maps and recognition need.
struct TexturedMotion {
  int width = 0, height = 0;
  int num_planes = 1;  ///< 1 = grey, 3 = colour
  double frames_per_sec = 25;
  std::int64_t num_frames = 0;  ///< of the clip it was learned from
  std::string source;           ///< its name, for people
  std::uint64_t seed = 0;

  Planes background;  ///< num_planes, grey levels
  BackgroundKind background_kind = BackgroundKind::kMedian;
  double noise = 0;  ///< deviation of a pixel from background + bases, grey levels
  SharedFlow flow;

  std::vector<MovetonTemplate> templates;  ///< Ψ
  std::vector<MovetonDynamics> dynamics;   ///< one a template
  BirthDeathMaps maps;
  std::vector<Cable> cables;  ///< W

  std::optional<WaterModel> water;  ///< of water, whose cables are carried bases
};

}  // namespace motex
