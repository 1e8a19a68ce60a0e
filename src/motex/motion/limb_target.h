// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/motion/clip.h"

namespace motex {

/// "The hand is here at that frame."
struct LimbTarget {
  std::string joint;  ///< whose origin shall be there
  Index frame = 0;
  Vector3 position = Vector3::Zero();  ///< world, units
};

struct ReachOptions {
  double reach_ease = 0.5;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"reach_ease", "s", "time in which a limb goes to its place, and back to its own movement"},
          self.reach_ease, Range{0.02, 10});
  }
};

struct ReachedTarget {
  double distance_before = 0, distance_after = 0;  ///< units
  std::vector<int> joints;                         ///< that were turned, from the limb's tip upwards
};

/// Brings joints to places at frames, in place. The limb ends below the first joint with more than one child; it is
/// turned by damped least squares, and where that does not suffice, the spine down to the joint that carries the legs
/// helps. The turns, q_j → q_j · exp(w(t) δ_j), come and go with w smoothly, in options.reach_ease or less where a
/// pinned frame is nearer. The joint itself keeps its rotation in the world. Several targets are met together.
///
/// Warns for each target that is missed by more than 1 cm, saying by how much. Throws InvalidInput for a joint or frame
/// that does not exist or is pinned, two places of one joint at one frame, and a joint that nothing carries.
std::vector<ReachedTarget> reach_targets(Clip& clip, std::span<const LimbTarget> targets,
                                         const ReachOptions& options = {}, std::span<const Index> pinned = {},
                                         const JobContext& job = {});

}  // namespace motex
