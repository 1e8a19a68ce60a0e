// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/motion/clip.h"
#include "motex/motion/markers.h"

namespace motex {

/// Turns everything −90° about x, (x, y, z) → (x, z, −y): offsets, end sites, channel names, every joint's frame of
/// reference, so that the rest pose stands upright too. World positions turn alike, exactly. A skin is taken off.
void turn_z_up_to_y_up(Clip& clip);
void turn_z_up_to_y_up(MarkerSet& markers);
/// The inverse, (x, y, z) → (x, −z, y). What comes out is for writing alone: inside motex y is up.
void turn_y_up_to_z_up(Clip& clip);
void turn_y_up_to_z_up(MarkerSet& markers);

}  // namespace motex
