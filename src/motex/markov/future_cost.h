// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/markov/graph.h"

namespace motex {

/// What it costs to go on for ever from each node, later steps counting less:
///   V_i = min_j (w_ij + α V_j),
/// the fixed point that Q-learning of video textures [Schödl et al. 2000, section 3.1] approaches, found exactly by
/// policy iteration. Infinite where every way ends. α in (0, 1), weights finite and ≥ 0, else InvalidInput.
/// O(iterations · (nodes + edges)), about ten iterations.
std::vector<double> future_costs(const Graph& graph, double discount = 0.995);

}  // namespace motex
