// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <string_view>

#include "motex/core/matrix.h"

namespace motex {

using Vector3 = Eigen::Vector3d;
/// Unit quaternion; Eigen stores x, y, z, w, motex files and matrices w, x, y, z.
using Quat = Eigen::Quaterniond;

/// exp: R³ → SO(3); angle = ‖v‖ radians about v. Exact to rounding at v = 0.
Quat exp_map(const Vector3& v);
/// The shortest v with exp_map(v) = ±q, ‖v‖ ≤ π.
Vector3 log_map(const Quat& q);
/// The v with exp_map(v) = ±q that lies nearest to `near` (continuity along a clip; ‖v‖ may exceed π).
Vector3 log_map_near(const Quat& q, const Vector3& near);
/// Angle in radians, 0 … π, of the rotation from a to b.
double angle_between(const Quat& a, const Quat& b);
/// Mean rotation: principal eigenvector of Σ q qᵀ. quats: n × 4 (w, x, y, z), n ≥ 1.
Quat mean_rotation(const FrameMatrix& quats);

/// Axis index (0 = x, 1 = y, 2 = z) of each factor, in the order in which a BVH names its channels:
/// "zxy" means q = R_z(a) R_x(b) R_y(c).
struct EulerOrder {
  int axis[3] = {2, 0, 1};
};
Quat quat_from_euler(const EulerOrder& order, const Vector3& angles_rad);
/// Angles (radians) with quat_from_euler(order, angles) = ±q; of the two solutions and their turns, the one nearest to
/// `near`. At gimbal lock the first angle is kept from `near`. Orders whose first and last axes are equal are
/// supported.
Vector3 euler_from_quat(const EulerOrder& order, const Quat& q, const Vector3& near = Vector3::Zero());

}  // namespace motex
