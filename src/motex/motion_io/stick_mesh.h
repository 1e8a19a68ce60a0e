// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "motex/motion/skeleton.h"

namespace motex {

/// The skeleton at rest as a mesh: a pointed stick from each joint to each of its children and end sites, moved by that
/// joint alone. A skeleton without length gets one small diamond.
struct StickMesh {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::uint16_t> joints;  ///< the joint that moves each position
  std::vector<std::uint32_t> triangles;
};

/// scale: metres per unit.
StickMesh make_stick_mesh(const Skeleton& skeleton, double scale);

/// Positions of the joints with all rotations at identity, in the skeleton's unit.
std::vector<Vector3> rest_positions(const Skeleton& skeleton);

}  // namespace motex
