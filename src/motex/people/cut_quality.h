// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/people/cut_smoothness.h"
#include "motex/people/sprite.h"

namespace motex {

/// How a cut looks in the film.
struct CutQuality {
  /// Largest second differences anywhere in the transition and at both its ends, relative to real footage.
  CutSmoothness smoothness;
  double ssim = 1;        ///< of the first rendered frame to the last real one: the smaller of both ends
  double flow_error = 0;  ///< what optical flow from a frame to the next leaves: root mean square grey levels, mean
};

/// frames: two real ones, those rendered (none at a hard cut), two real ones, all at their places in the film. Throws
/// InvalidInput for fewer than four.
CutQuality cut_quality(const std::vector<Sprite>& frames, const SecondDifferenceScales& scales);

/// Mean structural similarity of luma over middle grey, over the pixels where either is not transparent; 1 for none.
double sprite_ssim(const Sprite& a, const Sprite& b);
/// Root mean square of R, G, B, alpha between b and what optical flow makes of a.
double flow_warp_error(const Sprite& a, const Sprite& b);

}  // namespace motex
