// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "motex/motion/clip.h"

namespace motex {

/// How far in-between frames lie from what was there: the measures of LaFAN1 [Harvey et al. 2020]. Joints alone, in the
/// world, without end sites; means over all frames of all gaps.
struct InbetweenErrors {
  double l2p = 0;  ///< ‖(p̂ − p)/σ‖ over all coordinates of all joints of a frame
  double l2q = 0;  ///< ‖q̂ − q‖ over the world quaternions of all joints of a frame, q̂ with the sign nearer to q
  double npss = 0;       ///< Σ |cumulated difference of normalised power spectra| of q's series, weighted by its power
  double npss_real = 0;  ///< the same with (Re F)² for the power |F|², as the published program has it
  Index num_gaps = 0;
};

/// σ: deviation of each coordinate (3 · joints) over windows of 65 frames, every 20th of each clip, moved and turned so
/// that the travelling joint stands at the origin with heading 0 in their tenth frame. At least 1e-6 of the largest.
/// Throws InvalidInput when no clip has a window.
Vector window_position_deviations(std::span<const Clip> clips, int travelling_joint);

class InbetweenMeasures {
 public:
  InbetweenMeasures(Vector position_deviations, int travelling_joint);

  /// truth: a clip; made: frames first … first + made.num_frames() − 1 of it as somebody filled them in, in the world
  /// of truth. Both are turned so that frame first − 1 of truth has heading 0. Throws InvalidInput for a gap that is
  /// not inside truth or has another skeleton.
  void add(const Clip& truth, const Clip& made, Index first);
  InbetweenErrors errors() const;

 private:
  void add_spectra(const FrameMatrix& truth, const FrameMatrix& made);

  Vector deviations_;
  int travelling_joint_;
  double positions_ = 0, quaternions_ = 0;  ///< sums over frames
  double shifted_power_[2] = {0, 0}, power_[2] = {0, 0};
  Index num_frames_ = 0, num_gaps_ = 0;
};

/// Baseline: frames first … first + count − 1 between frame first − 1 and frame first + count, by slerp of local
/// rotations and straight lines of translations.
Clip interpolate_gap(const Clip& clip, Index first, Index count);
/// Baseline, zero velocity: frame first − 1 held.
Clip hold_gap(const Clip& clip, Index first, Index count);

}  // namespace motex
