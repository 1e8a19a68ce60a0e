// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/matrix.h"
#include "motex/people/motif.h"

namespace motex {

/// Where something happens in a series.
struct Activity {
  std::vector<unsigned char> active;  ///< frame by frame; numbers that are not finite are not active
  std::vector<FrameSpan> idle;        ///< where nothing, or next to nothing, happens
  std::vector<double> brief_level;  ///< of each frame: deviation in 0.4 windows, in units of `scale`; −1 = not known
  std::vector<double> scale;        ///< of each signal: 95th percentile of its deviation in a window
  bool two_levels = false;          ///< idle and active stretches were told apart
};

/// Deviation in a window around each frame of what is left when the mean over `drift` frames on both sides is taken
/// off, in units of `scale`, root mean square over signals. Its logarithms fall into two classes (Otsu's threshold);
/// when the classes lie a factor of 2.8 apart, explain 72 % of the variance and the lower one is narrow, it is idle: a
/// drift and the noise of a person who stands still are less than an action. Otherwise all that changes is active, as
/// where an actor rests for a moment only between two actions. idle: runs of the lower class of at least `window`
/// frames; without two classes, runs of 0.6 windows whose deviation in 0.4 windows is at most a tenth of `scale`.
/// stretches: windows lie inside one; empty = the whole series.
Activity find_activity(const FrameMatrix& series, int window, int drift, const std::vector<FrameSpan>& stretches);

}  // namespace motex
