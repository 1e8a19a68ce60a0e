// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/base.h"
#include "motex/particles/textured_motion.h"

namespace motex {

/// Below this peak / median of the displacements a scene has no flow to rely on.
constexpr double kTrustedPeakRatio = 20;

struct FlowEstimate {
  SharedFlow flow;
  double spread_x = 0, spread_y = 0;  ///< deviation of the velocities of elements around it, pixels a frame
  bool is_trusted = false;            ///< peak_ratio ≥ kTrustedPeakRatio
  double share = 0;                   ///< of the detections that have one of the next frame there, beyond chance
};

/// Velocity shared by the elements: the peak of the histogram of displacements from every detection of a frame to every
/// one of the next within max_speed (pixels a frame; 0 = a quarter of the extent of the detections, at most 32), each
/// pair counted as a Gaussian of deviation 1 px. Detections that do not belong together spread over the whole
/// histogram; its median is their level.
FlowEstimate estimate_flow(const std::vector<std::vector<Base>>& frames, double max_speed = 0);

}  // namespace motex
