// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/image/planes.h"
#include "motex/particles/cable.h"

namespace motex {

/// Where the cores of a frame leave more of its light than the background alone does, their amplitudes are fitted to
/// the frame together (least squares, signs kept): those that were not seen there and those that had the same light
/// twice give it up, down to a fiftieth of what they had. Other frames stay as they are.
/// residuals: luma minus background of each frame. cables: cores alone, first coefficients.
void mend_light(const std::vector<Plane>& residuals, std::vector<Cable>& cables, int jobs);

}  // namespace motex
