// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "motex/motion_texture/model.h"

namespace motex {

/// Textons to play one after another.
struct TextonPath {
  std::vector<int> textons;
  double log_prob = 0;              ///< Σ log M over the transitions
  Index shortest = 0, longest = 0;  ///< frames, by the shortest and the longest examples: Σ l_k − 2 (n − 1)
};

struct TextonPaths {
  TextonPath best;
  std::optional<TextonPath> runner_up;
};

/// Best path over the model's transitions [MT02 5.2]: of any length by Dijkstra's algorithm on −log M, or with
/// num_textons > 0 of exactly that many, ends included. Throws InvalidInput for a texton that does not exist, or when
/// there is no path, naming what can be reached or which lengths are possible.
TextonPaths find_texton_paths(const MotionTexture& model, int from, int to, int num_textons = 0);

}  // namespace motex
