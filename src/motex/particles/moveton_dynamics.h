// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

namespace motex {

/// One coordinate of a moveton's state ξ over its life ([TM02] section 3; the matrices of the paper are diagonal):
///   z_t = a z_{t−1} + b z_{t−2} + c + d n,   n ~ N(0, 1),   t ≥ t_b + 2
///   z_{t_b+1} = a₀ z_{t_b} + c₀ + d₀ n
/// Places are translation invariant: a + b = 1, a₀ = 1, so φ = −b is the persistence of the velocity, c / (1 − φ) its
/// mean.
/// c differs from cable to cable by a deviation c_spread (beyond the paper: without it paths wiggle).
struct CoordinateDynamics {
  double a = 1, b = 0, c = 0, d = 1;
  double a0 = 1, c0 = 0, d0 = 1;
  double c_spread = 0;
  /// A cable's c goes with its beginning, which is its first step (places) or first value (others): mean
  /// c + c_slope (beginning − start_mean). draw_cable_constant() in fit_dynamics.h.
  double c_slope = 0;
  double start_mean = 0, start_deviation = 0;

  double persistence() const { return -b; }                            ///< φ, of places
  double mean_velocity() const { return b == -1 ? c0 : c / (1 + b); }  ///< of places, pixels a frame
};

/// Shared by all cables of one species.
struct MovetonDynamics {
  CoordinateDynamics x, y;       ///< pixels
  CoordinateDynamics log_scale;  ///< ln pixels
  CoordinateDynamics angle;      ///< radians, unwrapped
  CoordinateDynamics amplitude;  ///< peak of the core, grey levels (luma)
};

}  // namespace motex
