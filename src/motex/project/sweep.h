// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/plot/drawing.h"
#include "motex/project/held_out.h"

namespace motex {

/// A model learned with one threshold.
struct SweepPoint {
  double threshold = 0;  ///< cm (greedy), pieces a texton (merge) or nats (merge without paths)
  bool is_auto = false;  ///< the one that learning chooses by itself
  int num_textons = 0;
  int num_segments = 0;
  double mean_length_secs = 0, min_length_secs = 0, max_length_secs = 0;  ///< of segments
  Index num_frames = 0;                                                   ///< n, learned from
  double num_parameters = 0;                                              ///< k, see count_parameters
  double training_log_likelihood_per_frame = 0;
  double held_out_log_likelihood_per_frame = 0;
  double held_out_global_lds_log_likelihood_per_frame = 0;
  /// log L − ½ k log n, nats, of the frames learned from; larger is better.
  double bic = 0;
  /// Description length, nats; smaller is better: −log L, ½ log(frames of the texton) for each of a texton's own
  /// numbers, ½ log n for each other one, and log(lengths that a segment may have) a segment, which log L does not
  /// hold.
  double mdl = 0;
};

/// Free parameters of a model: each texton's A (2d²), D (d) and BBᵀ (d(d + 1)/2), the transition matrix (N(N − 1)),
/// each subspace (mean D, basis D·d − d(d + 1)/2) and the deviation outside it. Dynamics that textons share count once.
double count_parameters(const MotionTexture& model);

/// Learns on split.training with each threshold (none: the automatic one and six more: a quarter to four times
/// as large, or 3 … 1000 nats where it is 0) and scores split.held_out. Points come in order of threshold.
std::vector<SweepPoint> sweep_threshold(const HeldOutSplit& split, const std::vector<double>& thresholds,
                                        const LearnOptions& options, const JobContext& job = {});

/// Four panels over the threshold: textons, lengths of segments, held-out likelihood against one global system, BIC and
/// MDL. unit: of the threshold.
Drawing draw_sweep(const std::vector<SweepPoint>& points, const std::string& unit);

/// One row a point, columns named as the fields.
std::string sweep_csv(const std::vector<SweepPoint>& points);

}  // namespace motex
