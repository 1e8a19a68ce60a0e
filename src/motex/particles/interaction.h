// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/particles/cable.h"
#include "motex/particles/flow_field.h"

namespace motex {

/// A local interaction term ([TM02], last page): with u_i = v_i − flow(x_i), the velocity of cable i beyond the flow,
///   u_i(t + 1) = φ u_i(t) + γ Σ_j w_ij u_j(t) / Σ_j w_ij + noise,   w_ij = exp(−|x_i − x_j|² / 2r²), j ≠ i
struct Interaction {
  double persistence = 0;        ///< φ
  double coupling = 0;           ///< γ
  double coupling_error = 0;     ///< its standard error
  double persistence_alone = 0;  ///< φ without neighbours
  /// Share of the variance of u(t + 1) that is explained in frames that were not fitted.
  double explained_alone = 0, explained_with = 0;
  std::int64_t num_steps = 0;  ///< fitted
};

/// Least squares on the first 70 % of the frames, both components together, tested on the rest. Steps count where the
/// cable has two steps and there is a neighbour within 3 r. flow without planes: the mean velocity of all cables is
/// taken off instead.
Interaction measure_interaction(const std::vector<Cable>& cables, std::int64_t num_frames, const FlowField& flow,
                                double radius);

}  // namespace motex
