// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/image/planes.h"

namespace motex {

struct FlowFieldOptions {
  int spacing = 8;        ///< pixels between grid points
  int window = 24;        ///< side of the square over which one velocity is measured, pixels
  int max_speed = 12;     ///< pixels a frame, each way
  double smoothing = 12;  ///< deviation of the Gaussian that fills in where nothing moves, pixels
};

/// Velocity of falling water, which differs from place to place and not in time: on a grid of points `spacing` apart,
/// the first at (0, 0).
struct FlowField {
  int spacing = 8;
  Plane vx, vy;    ///< pixels a frame, one value a grid point; empty planes: no motion anywhere
  Plane strength;  ///< share of the light at a grid point that arrives where vx, vy say, 0 … 1

  struct Velocity {
    double x = 0, y = 0;
  };
  /// Bilinear; outside, the value at the edge.
  Velocity at(double x, double y) const;
};

/// For each window, the displacement d that maximises Σ_t Σ_x r_t(x) r_{t+1}(x + d), sub-pixel by a parabola; the sum
/// over time makes it robust where light flickers. residuals r: frames minus background (≥ 2, one size); slow changes
/// of light are taken out first. At most 32 pairs of frames are used. Cost (2 max_speed + 1)² · pixels · pairs.
/// Throws InvalidInput.
FlowField estimate_flow_field(const std::vector<Plane>& residuals, const FlowFieldOptions& options = {}, int jobs = 0);

}  // namespace motex
