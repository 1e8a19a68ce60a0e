// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/particles/background.h"
#include "motex/particles/cable.h"
#include "motex/particles/clip_frames.h"

namespace motex {

/// What the elements of a clip move before, and what they leave: residual = luma − background. One picture for the
/// whole clip; with kSmooth (a moving camera) one a frame, of which `still` is the middle one.
class ClipBackground {
 public:
  /// From up to 61 frames spread evenly over the clip.
  ClipBackground(const ClipFrames& clip, BackgroundKind kind, const JobContext& job);

  BackgroundKind kind() const { return kind_; }
  /// Grey or colour, as the clip is.
  const Planes& still() const { return still_; }
  const std::vector<Plane>& residuals() const { return residuals_; }

  /// Estimates a still background again from what the cables leave of the clip (a dense scene biases the median by
  /// grey levels). Cables of a clip in colour must have coefficients of three planes.
  void refresh(const ClipFrames& clip, const std::vector<Cable>& cables, const JobContext& job);

  /// A still background plus a change of its luma.
  void shift(const ClipFrames& clip, const Plane& luma_change, int jobs);

 private:
  void update_residuals(const ClipFrames& clip, int jobs);

  BackgroundKind kind_;
  Planes still_;
  std::vector<Plane> smooth_;  ///< luma, one a frame; kSmooth only
  std::vector<Plane> residuals_;
};

/// The frame as planes: its colours, or its luma where the clip is grey.
Planes frame_planes(const ClipFrames& clip, int frame);

/// Frames minus one background, luma.
std::vector<Plane> luma_residuals(const ClipFrames& clip, const Planes& background, int jobs = 1);

/// residuals, of frames 0 …, minus all bases of the cables, whose first coefficient counts.
void subtract_cables(std::vector<Plane>& residuals, const std::vector<Cable>& cables, int jobs);

/// 10 log₁₀(255² / mean square) over all planes, dB.
double psnr_of(const std::vector<Plane>& residuals);

}  // namespace motex
