// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/image/planes.h"

namespace motex {

/// The layer that the bases are added to (beyond [TM02], whose bases stand on nothing: 16–25 dB at 800 bases against
/// 24–64 over a background).
enum class BackgroundKind {
  kAuto,    ///< median, or smooth where that leaves less: a camera that moves
  kMedian,  ///< median over time of each pixel
  kLow,     ///< 20 % quantile over time: bright things that cover a pixel half of the time
  kSmooth,  ///< the frame itself, blurred by 12 px: for a moving camera and single pictures
  kFlat     ///< one level for the whole frame: the paper's way
};

/// Background of `frame` from frames of its surroundings (it may be one of them), all of one size and number of planes.
/// kind: what kAuto stood for is written back. Throws InvalidInput when sizes differ.
Planes estimate_background(const Planes& frame, const std::vector<Planes>& frames, BackgroundKind& kind);

/// Per pixel the value below which that share (0 … 1) of the frames lies. Throws InvalidInput without frames.
Planes quantile_over_time(const std::vector<Planes>& frames, double share);

const char* name_of(BackgroundKind kind);

}  // namespace motex
