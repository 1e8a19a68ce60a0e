// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/series_windows.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr int kShortestWindow = 4;
constexpr double kConstant = 1e-12;

void check(const FrameMatrix& series, int window, const std::vector<FrameSpan>& stretches) {
  if (series.cols() < 1) throw InvalidInput("the series has no signal");
  if (window < kShortestWindow)
    throw InvalidInput("a window of " + std::to_string(window) + " frames is too short: use 4 or more");
  if (series.rows() < window)
    throw InvalidInput("the series has " + std::to_string(series.rows()) + " frames, fewer than the window's " +
                       std::to_string(window));
  for (const FrameSpan& stretch : stretches)
    if (stretch.start < 0 || stretch.length < 0 || stretch.end() > series.rows())
      throw InvalidInput("a stretch of frames " + std::to_string(stretch.start) + " … " +
                         std::to_string(stretch.end() - 1) + " lies outside the series of " +
                         std::to_string(series.rows()) + " frames");
}

/// Windows that lie inside a stretch and hold only finite numbers.
std::vector<unsigned char> whole_windows(const FrameMatrix& series, int window,
                                         const std::vector<FrameSpan>& stretches) {
  const int num_frames = static_cast<int>(series.rows());
  const auto num_windows = static_cast<std::size_t>(num_frames - window + 1);
  std::vector<unsigned char> usable(num_windows, stretches.empty() ? 1 : 0);
  for (const FrameSpan& stretch : stretches)
    for (int start = stretch.start; start + window <= stretch.end(); ++start)
      usable[static_cast<std::size_t>(start)] = 1;
  for (int frame = 0; frame < num_frames; ++frame) {
    if (series.row(frame).allFinite()) continue;
    for (int start = std::max(0, frame - window + 1); start <= std::min(frame, num_frames - window); ++start)
      usable[static_cast<std::size_t>(start)] = 0;
  }
  return usable;
}

void copy_centred(const FrameMatrix& series, int s, double* out) {
  double sum = 0, count = 0;
  for (Index frame = 0; frame < series.rows(); ++frame)
    if (std::isfinite(series(frame, s))) {
      sum += series(frame, s);
      count += 1;
    }
  const double mean = count > 0 ? sum / count : 0;
  double last = 0;
  for (Index frame = 0; frame < series.rows(); ++frame) {
    if (std::isfinite(series(frame, s))) last = series(frame, s) - mean;
    out[frame] = last;
  }
}

}  // namespace

double SeriesWindows::distance(int a, int b) const {
  if (deviation(a) == 0 || deviation(b) == 0) return std::sqrt(2.0 * window);
  const double scale_a = 1 / deviation(a), scale_b = 1 / deviation(b);
  double sum = 0;
  for (int s = 0; s < num_signals; ++s) {
    const double *x = signal(s) + a, *y = signal(s) + b;
    const double mean_a = mean(s, a), mean_b = mean(s, b);
    for (int t = 0; t < window; ++t) {
      const double difference = (x[t] - mean_a) * scale_a - (y[t] - mean_b) * scale_b;
      sum += difference * difference;
    }
  }
  return std::sqrt(sum);
}

SeriesWindows series_windows(const FrameMatrix& series, int window, const std::vector<FrameSpan>& stretches) {
  check(series, window, stretches);
  SeriesWindows out;
  out.window = window;
  out.num_frames = static_cast<int>(series.rows());
  out.num_windows = out.num_frames - window + 1;
  out.num_signals = static_cast<int>(series.cols());
  out.usable = whole_windows(series, window, stretches);
  const auto frames = static_cast<std::size_t>(out.num_frames), windows = static_cast<std::size_t>(out.num_windows);
  const auto signals = static_cast<std::size_t>(out.num_signals);
  out.values.resize(signals * frames);
  out.means.assign(signals * windows, 0);
  out.deviations.assign(windows, 0);
  for (std::size_t s = 0; s < signals; ++s) {
    double* values = out.values.data() + s * frames;
    copy_centred(series, static_cast<int>(s), values);
    for (std::size_t start = 0; start < windows; ++start) {
      const double* x = values + start;
      double sum = 0, squares = 0, largest = 0;
      for (int t = 0; t < window; ++t) sum += x[t];
      const double mean = sum / window;
      for (int t = 0; t < window; ++t) {
        squares += (x[t] - mean) * (x[t] - mean);
        largest = std::max(largest, std::abs(x[t]));
      }
      out.means[s * windows + start] = mean;
      const double variance = squares / window;
      if (out.usable[start] != 0 && std::sqrt(variance) > kConstant * largest) out.deviations[start] += variance;
    }
  }
  for (std::size_t start = 0; start < windows; ++start) {
    out.deviations[start] = std::sqrt(out.deviations[start]);
    if (!(out.deviations[start] > 0)) out.usable[start] = 0;
  }
  return out;
}

}  // namespace motex
