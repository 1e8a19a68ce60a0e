// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/matrix.h"

namespace motex {

/// Rows first … last of RevisitSource, played once. The pair (last, last + 1) is where it hands over to the next visit,
/// or the last two frames.
struct Visit {
  Index first = 0;
  Index last = 0;
};

/// The example to play, and after it others of its texton that may be visited.
struct RevisitSource {
  FrameMatrix rows;  ///< features, one example after another
  Vector speeds;     ///< mean joint speed from each row to the next, any unit; not used in an example's last row
  std::vector<Index> starts;  ///< first row of each example; 0 is the one to play
};

/// Ways through frames of examples that come from the first pair of frames of one to its last in more, or fewer, steps
/// than it has: now and then the movement goes on from another frame whose surroundings look alike, as in a video
/// texture. Such a cut from row a to row b costs
///
///   1/2 + (δ(a, b)/τ)² (+ 1/2 into another example),   δ: root mean square distance in cm of the frames within 0.1 s
///   of a and of b
///
/// For every number of steps the cheapest way is found exactly:
///
///   H(r, m) = min(H(r − 1, m − 1), G(r − min, m − min)) + λ s,   G(b, m) = min_a H(a, m) + cost(a, b)
///
/// λ s favours quick (λ < 0) or slow parts, s: how much faster the body moves at a row than usual. Cost O(rows² ·
/// steps).
class RevisitPlanner {
 public:
  /// Visits last at least 0.4 s, or a third of the wanted steps where those are few.
  RevisitPlanner(const RevisitSource& source, double tau, double frame_time_secs, Index wanted_steps);

  struct Way {
    std::vector<Visit> visits;
    Index num_steps = 0;     ///< Σ (last − first)
    double cost = 0;         ///< of the cuts
    double speed = 0;        ///< mean of the rows played / mean of the example to play
    double largest_cut = 0;  ///< cm
  };
  /// The cheapest way for each number of steps from `fewest` to `most` that has one.
  std::vector<Way> ways(Index fewest, Index most, double lambda) const;

 private:
  struct Table;
  void walk(Table& table, Index m) const;
  void cut(Table& table, Index m) const;
  Way trace(const Table& table, Index steps) const;

  Index last_;  ///< row of the last pair of the example to play
  Index min_steps_;
  Vector speed_, excess_;          ///< relative to the example's mean; s
  std::vector<Index> begin_;       ///< of each row: first row of its example
  std::vector<Index> landings_;    ///< rows at which a visit may begin
  FrameMatrix distances_, costs_;  ///< of cuts; infinite where there must be none
};

}  // namespace motex
