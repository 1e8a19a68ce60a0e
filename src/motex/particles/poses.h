// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/core/matrix.h"
#include "motex/markov/transition_matrix.h"

namespace motex {

/// What one cable looks like in each of its frames.
struct PoseSequence {
  Matrix patches;               ///< frames × pixels of a normalised patch (moveton_patch.h)
  std::vector<char> is_usable;  ///< one a frame: nothing else near
};

struct FindPosesOptions {
  int max_poses = 5;
  double min_variance = 0.01;  ///< mean squared distance of patches of unit norm from the mean of their cable
  double min_distance = 0.02;  ///< squared, between the mean patches of two poses
  double min_silhouette = 0.44;
  double prior_count = 1;  ///< of the transition matrix
  std::uint64_t seed = 1;
};

/// The states that elements of one species take again and again ([TM02] Figures 5, 6: wings up, level, down) and how
/// they follow one another.
struct Poses {
  std::vector<std::vector<int>> sequences;  ///< state in each frame of each cable
  TransitionMatrix transitions;
  double silhouette = 0;
  int num() const { return transitions.num_states(); }
};

/// Patches are clustered after the mean of their cable is taken off; the number of states is what the patches show: one
/// when they hardly vary along a cable, form one cloud, or when states are never come back to (what fades is no
/// repeating state). Then a hidden Markov chain with these Gaussians is fitted (Baum–Welch) and each cable gets its
/// most probable sequence; frames that are not usable follow their neighbours. The matrix counts those sequences.
/// States by falling share.
Poses find_poses(const std::vector<PoseSequence>& cables, const FindPosesOptions& options = {});

}  // namespace motex
