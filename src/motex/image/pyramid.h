// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/image/planes.h"

namespace motex {

/// Half of each side, rounded up: pixel (x, y) is the mean around (2x, 2y) with weights (1 4 6 4 1)/16 both ways; edge
/// pixels are repeated outwards. [Burt and Adelson 1983]
Plane halve(const Plane& plane);
/// Recomputes the pixels left … right, top … bottom (inclusive, cut to the plane) of `half`, which is halve(plane).
void update_half(const Plane& plane, Plane& half, int left, int top, int right, int bottom);

/// The plane itself, its half, … : num_levels planes.
std::vector<Plane> gaussian_pyramid(const Plane& plane, int num_levels);

/// Convolution with a Gaussian of deviation sigma ≥ 0 pixels, edge pixels repeated outwards.
Plane gaussian_blur(const Plane& plane, double sigma);

}  // namespace motex
