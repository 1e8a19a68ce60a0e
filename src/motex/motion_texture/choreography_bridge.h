// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <vector>

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
  std::uint64_t variation = 0;  ///< not 0: another way; every example costs up to some transitions more, by this seed
  double liveliness = 0;        ///< what a second of an example costs less, times its u (liveliness.h)
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

/// The instance that holds the pair of consecutive corpus rows that begins at `row`.
int instance_at(const MotionTexture& model, Index row);

/// Step in cm that the body makes from frame to frame in the liveliest thousandth of the examples. Steps and turns of
/// the root do not count.
double fastest_step(const MotionTexture& model);

/// Bending the first or last poses of a dance costs this much more than bending those at a joint; and what a jump
/// costs.
constexpr double kBend = 2;
inline const double kJumpCost = std::log(1.3 / 0.3);
/// (log(length/source_length) / log(1 + stretch))².
double pace_cost(Index source_length, Index length, double stretch);
/// Distance in cm (root mean square over the two frames) of poses, 2 × D, from those at a corpus row.
double pose_distance(const MotionTexture& model, const FrameMatrix& poses, Index row);

/// Least of them over all rows.
double distance_from_model(const MotionTexture& model, const FrameMatrix& poses);

/// One stretch of example frames r … r + n − 1, wherever it begins, played in N frames and bent to the wanted poses at
/// both ends: what is left where N is shorter than any texton. Costs
///
///   2 (δ_start(r) + δ_end(r + n − 2))/τ + 2 log(1.3/0.3) + (log(N/n) / log(1 + stretch))².
///
/// The body must not move faster than `fastest` on the straight way between the poses, which bounds N from below; the
/// longest run bounds it from above. O(corpus · D) once, O(corpus · lengths) for each N.
class ChoreographyBridge {
 public:
  ChoreographyBridge(const MotionTexture& model, const PlanRequest& request, double tau, double fastest);

  Index least_frames() const { return least_; }
  Index most_frames() const { return most_; }
  /// cost is infinite when N is out of bounds.
  Plan plan(Index num_frames) const;

 private:
  const MotionTexture& model_;
  const PlanRequest& wanted_;
  double tau_;
  Index least_ = 4, most_ = 0;
  Vector from_start_, to_end_;  // δ by corpus row; infinite for the last row of a run
};

}  // namespace motex
