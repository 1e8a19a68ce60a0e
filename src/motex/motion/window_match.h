// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "motex/core/job.h"
#include "motex/core/matrix.h"

namespace motex {

/// How well two series cover each other, window by window. c(t, k) = ‖generated_t − reference_k‖₂.
struct WindowMatchReport {
  /// Share of the reference's windows of `window` frames whose best match in the generated series costs less than
  /// `threshold` per frame, in mean.
  double coverage = 0;
  /// Cost per frame of the best cutting of the generated series into pieces of at least `window` frames, each laid on a
  /// stretch of the reference of the same length.
  double global_diversity = 0;
  /// Mean over the generated series' windows of `local_window` frames of their best match's cost per frame.
  double local_diversity = 0;
  Index num_reference_windows = 0;
};

struct WindowMatchOptions {
  Index window = 30;
  Index local_window = 15;  ///< at most window
  double threshold = 2.0;
};

/// The measures of GANimator [Li et al. 2022], exactly: the published best cutting tries every cut and every place,
/// here it is a semi-Markov recursion over the diagonals k − t of c,
///
///   H(t, k) = min(H(t−1, k−1) + c(t, k),  G(t − w) + Σ_{s<w} c(t−s, k−s)),   G(t) = min_k H(t, k),   G(−1) = 0.
///
/// reference: series one after another, of run_lengths frames; no window crosses from one into the next.
/// generated: one series. Both frames × features. Cost 2 · generated · reference · features in single precision;
/// memory about 150 bytes a frame beside the arguments. Throws InvalidInput when either side has no window, Cancelled.
WindowMatchReport match_windows(const FrameMatrixF& reference, std::span<const Index> run_lengths,
                                const FrameMatrixF& generated, const WindowMatchOptions& options = {},
                                const JobContext& job = {});

}  // namespace motex
