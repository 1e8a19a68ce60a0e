// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "motex/particles/cable.h"

namespace motex {

/// A cable whose light two others take over (fork), or the other way round in time (merge).
struct Fork {
  std::int64_t frame = 0;    ///< last frame of the one (fork), first frame of the one (merge)
  int one = 0;               ///< index of the cable
  std::array<int, 2> two{};  ///< those that begin in the next frame (fork), end in the frame before (merge)
  double left = 0;           ///< share of the energy of the one that the two do not show
  double x = 0, y = 0;       ///< where, pixels
};

struct ForksReport {
  std::vector<Fork> forks, merges;
  double num_steps = 0;  ///< of cables, which might be forks
  /// What would be found by chance: with the cables that begin (end) a few frames later or earlier, for which there is
  /// no reason to go on with the light of this one.
  double forks_by_chance = 0, merges_by_chance = 0;
};

/// Bifurcations ([TM02], last page). The core of a cable, α b, moved on by its velocity, is compared with the cores
/// α₁ b₁, α₂ b₂ that go on with its light in the next frame: two that begin there nearby, or the cable itself and one
/// that begins. A fork is where each shows at least a fifth of it, α_k ⟨b, b_k⟩ ≥ α / 5, and both together leave at
/// most half of its energy, ‖α b − α₁ b₁ − α₂ b₂‖² ≤ α² / 2, and less than three quarters of what the better one leaves
/// alone. Merges are forks of the clip shown backwards. width, height: of the picture.
ForksReport find_forks(const std::vector<Cable>& cables, std::int64_t num_frames, int width, int height);

}  // namespace motex
