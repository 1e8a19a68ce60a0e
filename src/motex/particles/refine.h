// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/particles/base.h"

namespace motex {

/// A base fitted to an image: the image is nearest to coefficient · patch.
struct FittedBase {
  Base base;
  BasePatch patch;
  float coefficient = 0;
};

/// Moves, scales and turns the base continuously so that it takes the most energy from `image`: maximises
/// ⟨image, b⟩² / ‖b‖² over (x, y, ln s, θ) from `start` by at most num_steps damped Gauss–Newton steps. The energy
/// never falls; scales stay within 0.6 … 10 px, the centre inside the image. num_steps = 0 fits the coefficient alone.
FittedBase refine_base(const Plane& image, const Base& start, int num_steps);

/// Joint least squares: the coefficients for which Σ α_j patch_j is nearest to `image`, by conjugate gradients from
/// `start`. The squared error never rises. Returns as many coefficients as there are patches.
std::vector<float> fit_coefficients(const Plane& image, const std::vector<BasePatch>& patches,
                                    const std::vector<float>& start);

}  // namespace motex
