// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/rng.h"
#include "motex/motion_texture/synthesize.h"

namespace motex {

/// Random walk over the instances of a model [MT02 5.1]: from instance a (texton i) to b (texton j) with
///
///   p(b) ∝ M_ij · exp(−distance(end of a, key poses of b) / τ) / (1 + times b was played)²
///
/// τ = nearness × median over instances of the distance to the nearest key poses that do not follow in the source; the last
/// factor keeps the dance from going in circles.
class InstanceWalk {
 public:
  InstanceWalk(const MotionTexture& model, const SynthesizeOptions& options, std::vector<int> path, bool endless);

  /// The instance to play next, or −1 where a path that is not endless is over. The first call gives the first one.
  int next();

 private:
  int choose(const std::vector<int>& among, const std::vector<double>* transition_row);
  bool is_allowed(int instance) const;

  const MotionTexture& model_;
  KeyPoses key_poses_;
  std::vector<int> path_;
  bool endless_;
  Rng rng_;
  double tau_ = 1;
  std::size_t path_done_ = 0;
  int current_ = -1;
  std::vector<int> allowed_;           ///< instances of the largest connected part
  std::vector<bool> texton_allowed_;
  std::vector<double> times_played_;
};

}  // namespace motex
