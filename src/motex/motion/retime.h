// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "motex/motion/clip.h"

namespace motex {

/// The clip as it is at these moments, counted in its frames (2.5: between frames 2 and 3; before the first and after
/// the last it stands still). Through four frames goes a cubic, of translations as they are, of rotations by the
/// exponential map about the frame before: positions and speeds are continuous, whole numbers give the frames
/// themselves. The frame time stays the clip's. Throws InvalidInput for a clip without frames or moments that are not
/// finite.
Clip retime(const Clip& clip, std::span<const double> moments);

/// Played `speed` times as fast, from the first frame to the last, at the clip's own rate. speed: 0.01 … 100.
Clip play_at_speed(const Clip& clip, double speed);

}  // namespace motex
