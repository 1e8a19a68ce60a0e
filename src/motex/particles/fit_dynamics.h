// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "motex/core/options.h"
#include "motex/core/rng.h"
#include "motex/particles/cable.h"
#include "motex/particles/moveton_dynamics.h"

namespace motex {

struct FitDynamicsOptions {
  /// Deviations of the measurement of each coordinate. All 0: cables are taken as they are (a sample of the chain).
  double position_error = 0;
  double log_scale_error = 0;
  double angle_error = 0;
  double amplitude_error = 0;
  /// The errors are found together with the dynamics (cables of detections); the four above are then not used.
  bool estimate_errors = false;
  double prior_steps = 4;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"position_error", "pixels", "deviation of measured places; 0: exact"}, self.position_error,
          Range{0, 100});
    visit(Field{"log_scale_error", "", "deviation of measured log scales; 0: exact"}, self.log_scale_error,
          Range{0, 10});
    visit(Field{"angle_error", "radians", "deviation of measured angles; 0: exact"}, self.angle_error, Range{0, 10});
    visit(Field{"amplitude_error", "grey levels", "deviation of measured amplitudes; 0: exact"}, self.amplitude_error,
          Range{0, 255});
    visit(Field{"estimate_errors", "", "find the errors of measurement together with the dynamics"},
          self.estimate_errors, Range{});
    visit(Field{"prior_steps", "steps", "weight of the prior belief (persistence 0.7)"}, self.prior_steps,
          Range{0, 1e6});
  }
};

struct FitDynamicsReport {
  std::int64_t num_cables = 0;  ///< of at least two frames
  std::int64_t num_steps = 0;   ///< from one frame to the next
  std::int64_t num_cuts = 0;    ///< steps left out: so far from the others that an identity was swapped there
  double position_error_x = 0;  ///< as given or found, pixels
  double position_error_y = 0;
};

/// Second-order dynamics shared by the cables of one species ([TM02] section 3: A, B, C, D, A₀, C₀, all diagonal).
///
/// Places: velocity v_t = z_t − z_{t−1} obeys v_t = φ v_{t−1} + c_i + d n with c_i ~ N(c, c_spread²) of cable i, which
/// is a = 1 + φ, b = −φ. The other coordinates: z_t = a z_{t−1} + b z_{t−2} + c_i + d n.
/// Exact cables: linear regression with random effects in closed form, c_i given the cable's beginning (so that short
/// cables do not bias φ); the ratio c_spread / d by a search in one dimension.
/// Measured cables, y = z + error: regression would find φ far too small (.1 – .3 for a true .7). There the likelihood
/// of a Kalman filter is maximised instead over φ, d, c_spread and, on request, the error; other coordinates then have
/// b = 0.
/// Steps more than seven robust deviations away from the others are left out and cut the cable in two.
/// Amplitudes are those of plane 0: for coloured cables put the luma's coefficient there.
/// Prior: prior_steps steps of persistence 0.7 and typical noise; it alone speaks when there is no step.
/// The texton fit of module lds does not serve here: it knows neither a + b = 1, nor effects of one cable, nor errors.
/// Cost: O(steps) once, then O(cables) for each step of the search (exact) or O(steps), about 300 times (measured).
MovetonDynamics fit_dynamics(std::span<const Cable> cables, const FitDynamicsOptions& options = {},
                             FitDynamicsReport* report = nullptr);

/// c_i of a cable of which only the beginning is known: `start` is its first step of a place, its first value of
/// another coordinate. Mean c + c_slope (start − start_mean); over all starts the deviation is c_spread.
double draw_cable_constant(const CoordinateDynamics& dynamics, double start, Rng& rng);

}  // namespace motex
