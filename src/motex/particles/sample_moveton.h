// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/rng.h"
#include "motex/particles/cable.h"
#include "motex/particles/moveton_patch.h"
#include "motex/particles/moveton_template.h"

namespace motex {

/// One moveton drawn from a template for its whole life: which coils it has and how they deviate is drawn once; the
/// state (wings) follows the template's chain; coils move, grow and turn with the core.
class SampledMoveton {
 public:
  SampledMoveton(const MovetonTemplate& moveton_template, int num_planes, Rng& rng);

  int pose() const { return pose_; }
  void set_pose(int pose) { pose_ = pose; }
  /// Draws the next frame's state.
  void advance(Rng& rng);
  /// Most coils of any state; every frame has so many (those of a state with fewer have coefficient 0).
  int num_coils() const { return num_coils_; }
  BaseKind core_kind() const;
  /// Appends num_coils() bases around a core that has its coefficients.
  void append_coils(const Base& core, std::vector<Base>& out) const;
  /// Planes' coefficients of a core from its luma coefficient, in the moveton's own colour.
  void colour_core(Base& core, double luma_coefficient) const;

 private:
  const MovetonTemplate* template_;
  int num_planes_;
  int pose_ = 0;
  int num_coils_ = 0;
  std::array<double, 3> colour_{};
  std::vector<std::vector<RelativeBase>> coils_;  ///< of each state
};

/// Core (first) and coils of one moveton at (x, y), its size, angle, brightness and state drawn too.
std::vector<Base> sample_moveton(const MovetonTemplate& moveton_template, int num_planes, double x, double y, Rng& rng);

/// Fills coils, poses and the colours of the core of a cable whose core has places, scales, angles and luma
/// coefficients (in coefficients[0]).
void dress_cable(Cable& cable, const MovetonTemplate& moveton_template, int num_planes, Rng& rng);

}  // namespace motex
