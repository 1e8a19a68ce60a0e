// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/matrix.h"
#include "motex/people/action_windows.h"
#include "motex/people/motif_code.h"
#include "motex/people/motifs.h"
#include "motex/people/template_match.h"

namespace motex {

/// Euclidean between z-normalised windows / √window.
inline double correlation_distance(double correlation) { return std::sqrt(std::max(0.0, 2 * (1 - correlation))); }

/// Least correlation of a match with its pattern.
inline constexpr double kAgree = 0.85;

/// Occurrences that chance may add to a motif.
inline constexpr double kStray = 0.05;

/// One action is performed with at most 1.9 times the amplitude of another time.
inline bool is_as_strong(double amplitude, double other) {
  constexpr double kMost = 1.9;
  return amplitude <= kMost * other && amplitude * kMost >= other;
}

/// A match or an occurrence and an occurrence are in each other's way: they share 0.3 of the shorter one.
template <typename Place>
bool overlaps(const Place& a, const Occurrence& b) {
  const int shared = std::min(a.start + a.length, b.start + b.length) - std::max(a.start, b.start);
  return shared > 0.3 * std::min(a.length, b.length);
}
template <typename Place>
bool is_taken(const std::vector<Occurrence>& occurrences, const Place& place) {
  return std::any_of(occurrences.begin(), occurrences.end(), [&](const Occurrence& o) { return overlaps(place, o); });
}

/// A pattern with what it matches, the closest first; the first is where it comes from.
struct MotifSeed {
  int window = 0;
  std::vector<Match> matches;
  std::vector<double> lambda;  ///< expected by chance at each match
  double gain = 0;             ///< nats: −ln P
  double saved = 0;            ///< nats: MotifCode
  int count = 0;               ///< occurrences within R
};

/// What find_motifs() looks at: the series and what chance makes of it.
struct MotifSearch {
  const FrameMatrix& series;  ///< of comparable units
  const FindMotifsOptions& options;
  const std::vector<FrameSpan>& stretches;
  const JobContext& job;
  ActionWindows action;
  PatternSearch frames;  ///< of the series
  MotifCode code;
  std::vector<PatternSearch> backgrounds{};  ///< of the length at hand
  double places = 0;                         ///< windows of the length at hand that may be an action
  bool whole_only = false;                   ///< ActionWindows::allow
};

/// Series that move as `active` does and repeat nothing within a window: by level and by differences.
std::vector<PatternSearch> backgrounds_of(const FrameMatrix& series, const std::vector<FrameSpan>& active, int window);

/// The count of least chance among the seed's matches (inside options.radius where it is given).
void rate(MotifSeed& seed, const MotifSearch& search);

/// The pattern repeats within itself: a shorter one tells more.
bool is_several(const MotifSearch& search, const MotifSeed& seed);

/// Patterns of every length with what they match. active: what the background is fitted to. num_patterns grows by the
/// number of different patterns there could be.
std::vector<MotifSeed> motif_seeds(const MotifSearch& search, const std::vector<int>& lengths,
                                   const std::vector<FrameSpan>& active, double& num_patterns);

}  // namespace motex
