// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "motex/core/matrix.h"
#include "motex/markov/transition_matrix.h"

namespace motex {

/// Frames start … start + length − 1 in one state.
struct Segment {
  int state = 0;
  Index start = 0;
  Index length = 0;
  bool operator==(const Segment&) const = default;
};

/// What a segmentation may look like, and how its segments begin. Lengths in frames.
struct SegmentOptions {
  Index min_length = 1;        ///< T_min ≥ 1
  Index max_length = 0;        ///< T_max ≥ T_min; 0 = no limit
  Index num_start_frames = 0;  ///< s ≤ T_min: first frames of a segment that emissions do not score
};

/// One sequence of T frames and the chain of N states it is segmented with. Views: the owner keeps the data alive.
struct SegmentationInput {
  /// F, T × N: log-likelihood of frame t in state i; segments add them up. −∞ = impossible. NaN or +∞:
  /// NumericalFailure.
  Eigen::Ref<const FrameMatrixF> emissions;
  /// init(b), T: log density of the s frames from b, the same for every state. Empty = 0. −∞ = nothing starts here.
  std::span<const double> start_log_density;
  const TransitionMatrix& transitions;
  SegmentOptions options = {};
  /// init_i(b), T × N: what a segment of state i that starts at frame b adds besides init(b). Empty = 0. −∞ = i does
  /// not start there.
  Eigen::Ref<const FrameMatrixF> state_start_log_density = FrameMatrixF();
};

struct SegmentationReport {
  std::vector<Segment> segments;  ///< in order, covering every frame; empty when no segmentation is possible
  double score = -std::numeric_limits<double>::infinity();
  bool is_feasible() const { return !segments.empty(); }
};

/// The segmentation of largest score [MT02 appendix A; docs/papers/motion-texture.md],
///
///   score = Σ_k [ init(b_k) + init_{l_k}(b_k) + Σ_{t = b_k + s}^{e_k} F_{l_k}(t) ] + Σ_{k ≥ 2} log M_{l_{k−1} l_k},
///
/// over all segments [b_k, e_k] with T_min ≤ length ≤ T_max that cover the sequence without gap, and all labels l_k.
/// The first label is free. Exact: a semi-Markov Viterbi recursion. With prefix sums S_i(t) = Σ_{u ≤ t} F_i(u)
///
///   E_i(b) = max_l [G_l(b−1) + log M_li],  E_i(0) = 0              best end just before a segment of i that starts at
///   b H_i(t) = max_b [E_i(b) + init(b) + init_i(b) − S_i(b+s−1)],  t − T_max < b ≤ t − T_min + 1 G_i(t) = S_i(t) +
///   H_i(t) best segmentation of 0 … t that ends in i
///
/// A sequence shorter than T_min is one segment, the only case in which a segment is shorter. When lengths in
/// T_min … T_max cannot add up to T, or impossible frames and transitions leave nothing, the report is infeasible:
/// score −∞, no segments. Of equal scores always the same is chosen. Sums are double.
///
/// Cost O(T · (N + non-zero counts)) whatever T_min and T_max are; memory 4 T N + 8 T_min N + 12 (T_max − T_min) N
/// bytes (α = 0: up to 8 T N more). Thread-safe: sequences can be segmented in parallel. Throws InvalidInput (sizes
/// that do not match, T ≤ s, options out of range) and NumericalFailure (NaN or +∞).
SegmentationReport segment_sequence(const SegmentationInput& input);

/// init(b) + init_i(b) + Σ F of one segment, without transitions. The segment must lie inside the sequence.
double segment_score(const SegmentationInput& input, const Segment& segment);

/// The score that segment_sequence() maximises, of given segments. InvalidInput when they break its rules: a gap, a
/// length outside T_min … T_max, a state that does not exist.
double score_segmentation(const SegmentationInput& input, std::span<const Segment> segments);

/// Throws InvalidInput unless sizes and options agree.
void check_segmentation_input(const SegmentationInput& input);

}  // namespace motex
