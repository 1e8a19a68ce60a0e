// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/particles/cable.h"
#include "motex/particles/clip_frames.h"
#include "motex/particles/textured_motion.h"

/// Small scenes whose truth is obvious, for tests.
namespace motex {

struct FallingDots {
  ClipFrames clip;
  Plane background;
  std::vector<Cable> cables;  ///< of Gaussians, by rising first frame
};

/// 96 × 64 grey pixels: dots of scale 1.5 and peak 100 over a level of 50 fall by (1, 2) pixels a frame, never nearer
/// than some 12 pixels to one another; new ones come in at the top and the left. Noise of one grey level (0 = none).
FallingDots make_falling_dots(int num_frames = 16, double noise = 1, std::uint64_t seed = 1);

/// A whole model whose hidden variables are those cables: one template of one Gaussian, dynamics and maps fitted.
TexturedMotion make_falling_dots_model(int num_frames = 16);

}  // namespace motex
