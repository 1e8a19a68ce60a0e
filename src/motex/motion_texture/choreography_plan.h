// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/motion_texture/model.h"
#include "motex/motion_texture/segment_synthesis.h"

namespace motex {

/// Two consecutive frames.
struct PlanPoses {
  FrameMatrix features;  ///< 2 × D
  Index row = -1;        ///< their first row in the corpus, or −1
};
PlanPoses poses_at(const MotionTexture& model, Index row);

/// What leads from one pair of poses to another in a given number of frames.
struct PlanRequest {
  PlanPoses start;       ///< output frames 0 and 1
  PlanPoses end;         ///< the last two output frames
  Index num_frames = 2;  ///< N, both pairs included
  double stretch = 0.15;
  double nearness = 1;
};

/// An example and how it is played: between which poses, in how many frames.
struct PlannedSegment {
  int instance = 0;
  Piece piece;                ///< first_row of the first segment and last_row of the last are those of the poses
  double first_distance = 0;  ///< cm from the example's own first poses to those that it starts from
  double last_distance = 0;   ///< cm from the example's own last poses to those that it leads to
};

struct Plan {
  std::vector<PlannedSegment> segments;  ///< Σ lengths − 2 (n − 1) = N: neighbours share two frames
  double cost = 0;
  double log_prob = 0;        ///< Σ log M over the transitions between the textons
  double start_distance = 0;  ///< cm from the start poses to the example's where the dance starts
  double end_distance = 0;    ///< cm from the end poses to the example's where the dance ends
};

/// The cheapest way from pose to pose in exactly N frames [MT02 5.2], by dynamic programming over (instance, frames so
/// far). Instance a, played in l frames and followed by b, costs
///
///   −log M + δ(a, b)/τ + (log(l/l_a) / log(1 + stretch))²,   l_a/(1 + stretch) ≤ l ≤ (1 + stretch) l_a,   l ≥ T_min
///
/// and 2 more when a = b. τ and δ as in InstanceWalk. The dance goes in by the rest of the instance that holds the
/// start frame and comes out by the beginning of the one that holds the end frame; or it starts, or ends, with any
/// instance whose first, or last, poses are bent to the wanted ones, at 2 δ/τ + log(1.3/0.3), where the logarithm is
/// what a jump costs.
///
/// Throws InvalidInput naming the nearest N when none of these makes N frames, or when N × instances is above 10⁸.
/// O(instances · N · (24 + stretched lengths)).
class ChoreographyPlanner {
 public:
  explicit ChoreographyPlanner(const MotionTexture& model);
  Plan plan(const PlanRequest& request, const JobContext& job = {}) const;

 private:
  struct Edge {
    int from = 0;
    double distance = 0;
    double log_prob = 0;
  };
  struct Search;
  void keep_edges();

  const MotionTexture& model_;
  double tau_;
  Index min_frames_;
  std::vector<std::vector<Edge>> predecessors_;  ///< by instance
};

/// The instance that holds the pair of consecutive corpus rows that begins at `row`.
int instance_at(const MotionTexture& model, Index row);

}  // namespace motex
