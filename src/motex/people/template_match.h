// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "motex/core/matrix.h"
#include "motex/people/motif.h"

namespace motex {

/// A place where a series resembles a pattern.
struct Match {
  int start = 0;
  int length = 0;
  double correlation = 0;  ///< over all signals together, after stretching the pattern to `length`
  double amplitude = 0;    ///< of the window: its deviation, √ of the sum of the signals' variances
  double rival = 0;        ///< highest correlation of a match 0.2 … 0.6 lengths away
};

/// Tempos at which a pattern is compared. Beyond the first kMatchedTempos nothing is matched: they only show that it is
/// no closer at another tempo.
inline constexpr std::array<double, 9> kTempos{1.0, 0.95, 1.05, 0.9, 1.1, 0.86, 1.16, 0.82, 1.22};
inline constexpr std::size_t kMatchedTempos = 7;
/// Frames that a pattern of `rows` frames takes at a tempo; at least 4.
int played_length(int rows, double tempo);

/// Pattern of an action: rows = frames, columns = signals, each column of mean 0, all together of norm 1 (0: constant).
using Pattern = FrameMatrix;

/// A series that patterns are looked for in; stretches are never crossed.
class PatternSearch {
 public:
  /// Signals in comparable units (SeriesWindows).
  PatternSearch(const FrameMatrix& series, const std::vector<FrameSpan>& stretches);

  /// The window as a pattern of `rows` frames (linear between frames).
  Pattern pattern(int start, int length, int rows) const;
  /// Highest correlations with the pattern played at 0.82 … 1.22 times its length, at least 0.6 lengths apart, falling;
  /// none below `least`.
  std::vector<Match> matches(const Pattern& pattern, double least) const;
  /// The highest correlation at those tempos where the middle lies within `reach` frames of `middle`; length 0: no
  /// whole window there.
  Match closest(const Pattern& pattern, int middle, int reach) const;
  /// Makes matches() of patterns of that many frames cheaper, until it is told another number. Not thread-safe.
  void prepare(int rows);
  double amplitude(int start, int length) const;
  /// All frames of the window are finite and of one stretch.
  bool whole(int start, int length) const;
  int num_frames() const { return num_frames_; }

 private:
  struct Norms {
    int length;
    std::vector<double> values;
  };
  /// Of the windows of that length, each less its mean; −1: not whole.
  std::vector<double> norms(int length) const;
  void correlate(const Pattern& pattern, std::vector<double>& out) const;

  int num_frames_ = 0, num_signals_ = 0;
  std::vector<std::vector<double>> values_, sums_, squares_;
  std::vector<Norms> norms_;
  std::vector<int> run_end_;  ///< frame → first frame after it where the stretch, or what is finite, ends
};

/// The pattern played in `rows` frames.
Pattern stretched(const Pattern& pattern, int rows);

}  // namespace motex
