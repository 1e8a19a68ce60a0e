// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>

#include "motex/core/options.h"
#include "motex/motion/clip.h"

namespace motex {

/// Where a body stands on the floor and which way it looks, frame after frame: metres or whatever the unit is, radians.
struct RootPath {
  Vector x, z, heading;
  Index num_frames() const { return x.size(); }
};

/// "Be there, facing this way, at that frame."
struct RootTarget {
  Index frame = 0;
  double x = 0, z = 0;
  std::optional<double> heading;  ///< any way it happens to face when not given
};

/// A box that stands on the floor, seen from above.
struct FloorBox {
  double x0 = 0, z0 = 0, x1 = 0, z1 = 0;
};

struct BendPathOptions {
  double body_radius = 30;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"body_radius", "cm", "distance that the root keeps from boxes"}, self.body_radius, Range{0, 1000});
  }
};

struct BendPathReport {
  double cost = 0;           ///< Σ a²/A + |b|²/B, below
  double largest_turn = 0;   ///< rad, farthest that the heading was turned away from the old one
  double largest_shift = 0;  ///< units, farthest from the old path
  double way = 1;            ///< length of the new path / length of the old one
  double clearance = 0;      ///< units, least distance of the root from a box; infinite without boxes
};

/// Bends a path so that it passes its targets and keeps clear of boxes. Steps v_t and turns Δψ_t of the heading frame,
///
///   p_t = p_{t−1} + R(ψ_{t−1}) (v_t + b_t),   ψ_t = ψ_{t−1} + Δψ_t + a_t,
///
/// get the corrections of least Σ a_t²/A_t + |b_t|²/B_t that meet the targets (Gauss and Newton, to 1e-9). A_t and B_t
/// go with how much the root moves, so that what stands still goes on standing, and turning is dearer than stepping
/// aside as 20 cm a radian is than a cm: feet would slide by that. Near frame 0, the last one, the targets and `fixed`
/// frames they go to 0, so that no speed jumps there. Frame 0 stays. Around a box the path is pushed out on the side on
/// which it takes least.
///
/// Throws InvalidInput for targets beyond the path, two at one frame, a target or fixed start inside a box, and when no
/// way around a box is found.
BendPathReport bend_root_path(RootPath& path, double frame_time_secs, double cm_per_unit,
                              std::span<const RootTarget> targets, std::span<const FloorBox> boxes = {},
                              std::span<const Index> fixed = {}, const BendPathOptions& options = {});

/// Least distance of the path from the boxes (negative inside one), and the frame where it is.
double clearance(const RootPath& path, std::span<const FloorBox> boxes, Index& frame);

}  // namespace motex
