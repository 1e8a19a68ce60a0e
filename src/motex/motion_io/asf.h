// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "motex/motion/skeleton.h"

namespace motex {

/// A number of a bone's line in the AMC.
struct AsfDof {
  bool rotation = true;
  int axis = 0;
};

struct AsfBone {
  std::string name;
  Vector3 end = Vector3::Zero();  ///< direction · length, in the world's axes at rest
  Quat axis = Quat::Identity();   ///< C
  int axis_order[3] = {0, 1, 2};  ///< applied first … last
  std::vector<AsfDof> dofs;       ///< in the order of the AMC's numbers
};

/// An .asf file. bones[i] belongs to skeleton.joints[i]; 0 is the root.
struct AsfSkeleton {
  Skeleton skeleton;
  std::vector<AsfBone> bones;
  bool degrees = true;
};

/// Throws ParseError with the line, UnsupportedFile for bones that slide or stretch.
AsfSkeleton read_asf_bytes(std::string_view bytes, const std::string& name);

/// R_last · … · R_first for angles (radians) about x, y, z.
Quat quat_from_axis_order(const int (&order)[3], const Vector3& angles_xyz);

}  // namespace motex
