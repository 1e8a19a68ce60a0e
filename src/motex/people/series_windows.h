// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "motex/core/matrix.h"
#include "motex/people/motif.h"

namespace motex {

/// The windows of m frames of a series of S signals, ready to be compared when each is z-normalised, all its signals
/// by one deviation, so that a signal counts as much as it moves there and what stands still adds no noise:
///   z_s,i(t) = (x_s(i + t) − μ_s,i) / σ_i,   σ_i² = Σ_s Σ_t (x_s(i + t) − μ_s,i)² / m,
///   correlation(i, j) = Σ_s Σ_t z_s,i(t) z_s,j(t) / m,   distance(i, j)² = Σ_s ‖z_s,i − z_s,j‖² = 2m (1 −
///   correlation).
/// Signals have to be in comparable units. A window is left out (not usable) when it holds a number that is not finite,
/// runs over the end of a stretch, or is constant in every signal. Constant: deviation at most 1e-12 of the largest
/// absolute number in the window.
struct SeriesWindows {
  int window = 0;       ///< m, frames
  int num_windows = 0;  ///< those that begin at frames 0 … num_windows − 1
  int num_signals = 0;  ///< S
  int num_frames = 0;
  std::vector<double> values;  ///< [signal · num_frames + frame], less the signal's mean; gaps hold the value before
  std::vector<double> means;   ///< [signal · num_windows + start], of values
  std::vector<double> deviations;     ///< [start], σ; 0 when constant or not usable
  std::vector<unsigned char> usable;  ///< [start]

  const double* signal(int s) const { return values.data() + offset(s, num_frames); }
  double mean(int s, int start) const { return means[offset(s, num_windows) + static_cast<std::size_t>(start)]; }
  double deviation(int start) const { return deviations[static_cast<std::size_t>(start)]; }
  /// Of two windows, from the numbers themselves; 2m is the square of no resemblance.
  double distance(int a, int b) const;

 private:
  static std::size_t offset(int s, int size) { return static_cast<std::size_t>(s) * static_cast<std::size_t>(size); }
};

/// series: rows = frames, columns = signals. stretches: windows lie inside one of them; empty = the whole series.
/// Throws InvalidInput: window below 4 frames or longer than the series, stretches outside it. Cost frames · m · S.
SeriesWindows series_windows(const FrameMatrix& series, int window, const std::vector<FrameSpan>& stretches = {});

}  // namespace motex
