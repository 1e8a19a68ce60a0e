// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/motion_texture/choreography_bridge.h"

namespace motex {

/// The cheapest way from pose to pose in exactly N frames [MT02 5.2], by dynamic programming over (instance, frames so
/// far). Instance a, played in l frames and followed by b, costs
///
///   −log M + δ(a, b)/τ + (log(l/l_a) / log(1 + stretch))²,   l_a/(1 + stretch) ≤ l ≤ (1 + stretch) l_a,   l ≥ T_min
///
/// and 2 more when a = b. τ and δ as in InstanceWalk. The dance goes in by the rest of the instance that holds the
/// start frame and comes out by the beginning of the one that holds the end frame; or it starts, or ends, with any
/// instance whose first, or last, poses are bent to the wanted ones, at 2 δ/τ + log(1.3/0.3), where the logarithm is
/// what a jump costs. Up to 2 T_min frames, and where nothing else fits, one stretch of any example's frames, wherever
/// it begins and ends, may be bent at both ends (ChoreographyBridge).
///
/// Throws InvalidInput naming the nearest N when none of these makes N frames, or when N × instances is above 10⁸.
/// O(instances · N · (24 + stretched lengths)).
class ChoreographyPlanner {
 public:
  explicit ChoreographyPlanner(const MotionTexture& model);
  Plan plan(const PlanRequest& request, const JobContext& job = {}) const;
  /// Mean u (liveliness.h) of what a plan plays, by frames.
  double mean_liveliness(const Plan& plan) const;

 private:
  struct Edge {
    int from = 0;
    double distance = 0;
    double log_prob = 0;
  };
  using Edges = std::vector<std::vector<Edge>>;  // into each instance
  struct Search;
  /// The `followers` cheapest of each instance, its own successor in any case, and the cheapest into each.
  Edges edges(std::size_t followers) const;
  [[noreturn]] void throw_nearest(const PlanRequest& request, const ChoreographyBridge& bridge,
                                  const JobContext& job) const;

  const MotionTexture& model_;
  double tau_;
  Index min_frames_;
  double fastest_;
  std::vector<double> liveliness_;
  Edges edges_;
};

}  // namespace motex
