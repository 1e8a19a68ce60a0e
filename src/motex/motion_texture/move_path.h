// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/motion_texture/corpus.h"

namespace motex {

/// Where a body goes in the T_min frames from each frame on: the states at kPoints times, evenly spread, as one vector
/// z of P numbers in units of the deviation within a texton.
struct PathWindows {
  FrameMatrixF values;         ///< frames × P
  std::vector<bool> is_whole;  ///< the window ends before its run does; else the row is 0
};

/// Sums over the windows of a group of segments; they add.
struct PathStatistics {
  double count = 0;
  Vector sum;  ///< P
  PathStatistics& operator+=(const PathStatistics& other);
};

/// Moves as pose paths. A segment of texton i that starts at frame b contributes, w times,
///
///   log N(z_b; m_i, I) − log N(z_b; 0, R),   m_i ~ N(0, R)
///
/// m_i = the texton's path, R (diagonal) = variance of all windows in the same units: the segment's window, told by the
/// texton, against a window drawn blindly. Variance within a texton is what reverse water-filling leaves when kShare of
/// the whole is to remain: σ² = θ in every direction with more than θ, Σ_j min(θ, λ_j) = kShare · Σ_j λ_j; directions
/// with less are not looked at.
class MovePaths {
 public:
  /// states: frames × d of the corpus in the shared subspace; min_frames = T_min; weight = w.
  MovePaths(const FrameMatrix& states, const std::vector<Run>& runs, Index min_frames, double weight);

  Index size() const { return ratio_.size(); }         ///< P; 0: nothing moves
  const PathWindows& windows() const { return own_; }  ///< of the corpus
  /// Of other frames of the same subspace.
  PathWindows windows(const FrameMatrix& states, const std::vector<Run>& runs) const;

  PathStatistics nothing() const { return {0, Vector::Zero(size())}; }
  /// Of one segment of the corpus by its first row.
  PathStatistics observe(Index row) const;
  /// w × log evidence ∫ Π_k N(z_k; m, I) N(m; 0, R) dm, without what does not change when groups are merged.
  double evidence(const PathStatistics& group) const;
  /// Of two groups taken together.
  double evidence(const PathStatistics& a, const PathStatistics& b) const;
  /// Most probable path of a group's texton; 0 (the mean pose) for an empty one.
  Vector path(const PathStatistics& group) const;
  /// w × log prior density of a path, 0 at its mode.
  double log_prior(const Vector& path) const;
  /// What a segment that starts there contributes: frames × textons; 0 where the window is not whole. One matrix
  /// product.
  FrameMatrixF start_densities(const PathWindows& windows, const std::vector<Vector>& paths,
                               const JobContext& job) const;

  static constexpr Index kPoints = 4;
  static constexpr double kShare = 0.14;

 private:
  double log_of(double count) const { return (1 + count * ratio_.array()).log().sum(); }

  double weight_;
  Index stride_, first_;          ///< frames
  std::vector<Index> channels_;   ///< of the states
  Vector mean_, scale_;           ///< of those channels; 1 / deviation within a texton
  Vector ratio_, inverse_ratio_;  ///< P: diagonal of R
  PathWindows own_;
  std::vector<double> log_terms_;  ///< Σ log(1 + n R) by count n, which merging asks for again and again
};

}  // namespace motex
