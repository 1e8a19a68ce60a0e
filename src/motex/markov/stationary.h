// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "motex/markov/transition_matrix.h"

namespace motex {

/// Share of time π that a chain kept among `states` spends in each of them: π = π M, Σ π = 1, in the order of `states`.
/// M: counts between these states, rows normalised, no prior. By elimination without subtraction (Grassmann, Taksar,
/// Heyman 1985), so that small shares keep their digits; O(n³). Throws InvalidInput unless they all reach one another.
std::vector<double> stationary_shares(const TransitionMatrix& transitions, std::span<const int> states);

}  // namespace motex
