// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/activity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "motex/core/quantile.h"

namespace motex {
namespace {

constexpr double kLeastRatio = 2.8;
constexpr double kLeastExplained = 0.72;
constexpr double kWidestIdle = 0.45;
constexpr double kStill = 0.1;                        // of the scale: a person who stands breathes and sways
constexpr double kBrief = 0.4, kShortestStill = 0.6;  // of the window
constexpr int kFewestFrames = 4;
constexpr double kConstant = 1e-9;  // of the largest number

/// x less its mean over `reach` frames before and after (fewer at the ends, alike on both sides), in one stretch;
/// frames that are not finite stay so.
void subtract_drift(FrameMatrix& series, const FrameSpan& part, int reach) {
  std::vector<double> sums(static_cast<std::size_t>(part.length) + 1), counts(sums);
  for (Index s = 0; s < series.cols(); ++s) {
    for (int t = 0; t < part.length; ++t) {
      const double x = series(part.start + t, s);
      const auto k = static_cast<std::size_t>(t);
      sums[k + 1] = sums[k] + (std::isfinite(x) ? x : 0);
      counts[k + 1] = counts[k] + (std::isfinite(x) ? 1 : 0);
    }
    for (int t = 0; t < part.length; ++t) {
      const int side = std::min({reach, t, part.length - 1 - t});
      const auto from = static_cast<std::size_t>(t - side), to = static_cast<std::size_t>(t + side + 1);
      series(part.start + t, s) -= (sums[to] - sums[from]) / std::max(1.0, counts[to] - counts[from]);
    }
  }
}

/// Of x[first … first + m) about its mean; 0 for what is constant but for rounding.
double deviation_in(const FrameMatrix& series, Index first, int m, Index s, double largest) {
  double sum = 0, squares = 0;
  for (int t = 0; t < m; ++t) sum += series(first + t, s);
  const double mean = sum / m;
  for (int t = 0; t < m; ++t) squares += (series(first + t, s) - mean) * (series(first + t, s) - mean);
  const double out = std::sqrt(squares / m);
  return out > kConstant * largest ? out : 0;
}

/// Threshold that divides the values into two classes of least variance, by the middles between neighbours.
struct Split {
  double threshold = 0, ratio = 0, explained = 0, low_deviation = 0;
};

Split otsu(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double v : values) {
    sum += v;
    squares += v * v;
  }
  const double variance = squares / n - (sum / n) * (sum / n);
  Split best;
  double below = 0, below_squares = 0;
  for (std::size_t k = 1; k < values.size(); ++k) {
    below += values[k - 1];
    below_squares += values[k - 1] * values[k - 1];
    const auto count = static_cast<double>(k);
    const double low = below / count, high = (sum - below) / (n - count);
    const double between = count * (n - count) / (n * n) * (high - low) * (high - low);
    if (variance <= 0 || between / variance <= best.explained) continue;
    best = {(values[k - 1] + values[k]) / 2, high - low, between / variance,
            std::sqrt(std::max(0.0, below_squares / count - low * low))};
  }
  return best;
}

constexpr double kUnknown = -1;

/// Of each signal the deviation in a window about every frame; −1 where it is not known.
std::vector<std::vector<double>> deviations(const FrameMatrix& series, const std::vector<FrameSpan>& parts, int window,
                                            const std::vector<double>& largest) {
  std::vector<std::vector<double>> out;
  for (Index s = 0; s < series.cols(); ++s) {
    out.emplace_back(static_cast<std::size_t>(series.rows()), kUnknown);
    for (const FrameSpan& part : parts)
      for (int frame = part.start; frame < part.end() && part.length >= window; ++frame) {
        const int first = std::clamp(frame - window / 2, part.start, part.end() - window);
        const double value = deviation_in(series, first, window, s, largest[static_cast<std::size_t>(s)]);
        if (std::isfinite(value)) out.back()[static_cast<std::size_t>(frame)] = value;
      }
  }
  return out;
}

/// Root mean square over signals, in units of their scales.
std::vector<double> levels(const std::vector<std::vector<double>>& deviation, const std::vector<double>& scale,
                           std::size_t num_frames) {
  std::vector<double> level(num_frames, kUnknown);
  for (std::size_t frame = 0; frame < num_frames; ++frame) {
    double sum = 0;
    bool known = true;
    for (std::size_t s = 0; s < deviation.size(); ++s) {
      known = known && deviation[s][frame] >= 0;
      if (scale[s] > 0) sum += deviation[s][frame] * deviation[s][frame] / (scale[s] * scale[s]);
    }
    if (known) level[frame] = std::sqrt(sum / static_cast<double>(deviation.size()));
  }
  return level;
}

/// Runs of at least `shortest` frames of one part with levels of at most `threshold`.
std::vector<FrameSpan> low_runs(const std::vector<double>& level, double threshold, int shortest) {
  std::vector<FrameSpan> runs;
  const auto is_low = [&](std::size_t frame) { return level[frame] >= 0 && level[frame] <= threshold; };
  for (std::size_t frame = 0; frame < level.size();) {
    std::size_t end = frame;
    while (end < level.size() && is_low(end)) ++end;
    if (end - frame >= static_cast<std::size_t>(shortest))
      runs.push_back({static_cast<int>(frame), static_cast<int>(end - frame)});
    frame = std::max(end, frame + 1);
  }
  return runs;
}

std::vector<double> largest_numbers(const FrameMatrix& series) {
  std::vector<double> largest(static_cast<std::size_t>(series.cols()), 0);
  for (Index s = 0; s < series.cols(); ++s)
    for (Index t = 0; t < series.rows(); ++t)
      if (double& most = largest[static_cast<std::size_t>(s)]; std::isfinite(series(t, s)))
        most = std::max(most, std::abs(series(t, s)));
  return largest;
}

}  // namespace

Activity find_activity(const FrameMatrix& given, int window, int drift, const std::vector<FrameSpan>& stretches) {
  FrameMatrix series = given;
  const auto num_frames = static_cast<std::size_t>(series.rows());
  std::vector<FrameSpan> parts = stretches;
  if (parts.empty()) parts.push_back({0, static_cast<int>(series.rows())});
  const std::vector<double> largest = largest_numbers(given);
  for (const FrameSpan& part : parts) subtract_drift(series, part, drift);
  const auto deviation = deviations(series, parts, window, largest);
  Activity out;
  for (const auto& values : deviation) {
    std::vector<double> known;
    for (const double v : values)
      if (v > 0) known.push_back(v);
    out.scale.push_back(known.empty() ? 0 : quantile(std::move(known), 0.95));
  }
  const std::vector<double> level = levels(deviation, out.scale, num_frames);
  std::vector<double> logarithms;
  for (const double one : level)
    if (one > 0) logarithms.push_back(std::log(one));
  double threshold = 0;
  if (logarithms.size() > 2) {
    const Split split = otsu(logarithms);
    out.two_levels = split.ratio >= std::log(kLeastRatio) && split.explained >= kLeastExplained &&
                     split.low_deviation <= kWidestIdle;
    if (out.two_levels) threshold = std::exp(split.threshold);
  }
  out.active.assign(num_frames, 0);
  for (std::size_t frame = 0; frame < num_frames; ++frame) out.active[frame] = level[frame] > threshold ? 1 : 0;
  const int brief = std::max(kFewestFrames, static_cast<int>(std::lround(kBrief * window)));
  out.brief_level = levels(deviations(series, parts, brief, largest), out.scale, num_frames);
  out.idle = out.two_levels ? low_runs(level, threshold, window)
                            : low_runs(out.brief_level, kStill, static_cast<int>(std::lround(kShortestStill * window)));
  return out;
}

}  // namespace motex
