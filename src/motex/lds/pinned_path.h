// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/lds/lds.h"

namespace motex {

/// Least-noise path of a system through any given states: of all paths that hold the pinned rows of `states` (l × d,
/// l ≥ 3), the one that minimises J = Σ_{t≥2} |B⁻¹(x_t − A₁ x_{t−1} − A₂ x_{t−2} − D)|², which is also the mean of the
/// system's paths through them. Writes the other rows and returns J. At least the two first rows must be pinned (throws
/// InvalidInput). Where Bridge takes two rows at each end, this takes single ones anywhere. Cost O(l d³).
double least_noise_path(const Lds& lds, const std::vector<bool>& pinned, Eigen::Ref<FrameMatrix> states);

}  // namespace motex
