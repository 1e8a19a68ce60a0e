// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/cable.h"

namespace motex {

/// Positions in depth from parallax ([TM02], last page): what is z times as far away is 1/z as large and, of the same
/// speed in space, 1/z as fast.
struct DepthReport {
  std::vector<double> depths;  ///< of each cable, relative to the typical one (1); 0 = unknown
  double correlation = 0;      ///< of ln scale and ln speed over the cables: what depth has to go by
  double slope = 0;            ///< of ln speed over ln scale (orthogonal regression); 1 = pure parallax
  int num_used = 0;            ///< cables of at least 5 frames that move
  bool reliable = false;       ///< correlation ≥ 0.3 and three standard errors, slope 0.4 … 2.5
};

/// ln z_i = −(a_i + b_i) / 2 with a, b the deviations of ln scale and ln speed (their medians over the cable's life)
/// from the medians over the cables; speeds are relative to nothing: the camera must stand still.
DepthReport estimate_depth(const std::vector<Cable>& cables);

}  // namespace motex
