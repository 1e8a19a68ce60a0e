// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/image/planes.h"

namespace motex {

/// Structural similarity at each pixel, 1 where both are alike:
///   (2 μ_a μ_b + c₁)(2 σ_ab + c₂) / ((μ_a² + μ_b² + c₁)(σ_a² + σ_b² + c₂)), c₁ = 2.55², c₂ = 7.65²,
/// means, variances and covariance under a Gaussian of 1.5 pixels. [Wang, Bovik, Sheikh, Simoncelli 2004]
/// Throws InvalidInput unless the sizes are equal.
Plane ssim_map(const Plane& a, const Plane& b);

}  // namespace motex
