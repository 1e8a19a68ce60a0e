// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/matrix.h"

namespace motex {

/// How many nats shorter a series is said when a performance of an action is coded as its likeness to another one: with
/// v(t) the variance about frame t, v̄ its mean over the L frames of the window and ρ the window's correlation with the
/// pattern, both codes Gaussian,
///   saved = ν/2 Σ_t ln(v(t) / ((1 − ρ²) v̄)) − ln T = ν/2 (Σ_t ln(v(t) / v̄) − L ln(1 − ρ²)) − ln T.
/// ν: independent numbers a frame; ln T: which frame of the series it is. What is alike gains; what differs from time
/// to time costs by the lower ρ; frames in which nothing happens cost, since they are said shortly anyway. Of n
/// performances one is coded in full, so a motif saves n − 1 times. One rule so decides between long windows and short
/// ones, one action and two.
class MotifCode {
 public:
  /// level: √v, in the units of the series; −1 = not known. window: frames, twice the lag of the differences that ν
  /// is estimated from.
  MotifCode(const FrameMatrix& series, const std::vector<double>& level, int window);
  /// By one performance in frames start … start + length − 1; 1 − ρ² counts as 0.001 at least.
  double saved(int start, int length, double correlation) const;

 private:
  std::vector<double> sums_, logarithms_;  ///< Σ v(t), Σ ln v(t)
  double freedom_ = 1, place_ = 0;
};

}  // namespace motex
