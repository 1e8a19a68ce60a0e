// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "motex/motion/clip.h"

namespace motex {

/// Several clips of one frame rate as one clip of several bodies, beside one another along x so that the rooms they
/// dance in are `margin` units apart; joint j of clip k is named "d<k + 1>:<name>". Where one is over it stands still.
/// Throws InvalidInput without clips or when frame rates differ.
Clip side_by_side(std::span<const Clip> clips, double margin);

}  // namespace motex
