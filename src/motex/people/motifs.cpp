// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/motifs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/quantile.h"
#include "motex/people/activity.h"
#include "motex/people/motif_refine.h"
#include "motex/people/motif_seeds.h"
#include "motex/people/trend.h"

namespace motex {
namespace {

constexpr int kShortestWindow = 4;
constexpr double kLengthStep = 1.12;
constexpr double kLevelSecs = 0.8;
constexpr double kDriftSecs = 5;
constexpr std::size_t kMostCandidates = 16;

std::vector<int> lengths(const FindMotifsOptions& options, int longest) {
  if (2 * options.window > longest)
    throw InvalidInput("windows of " + std::to_string(options.window) + " frames in a series of " +
                       std::to_string(longest) + ": say one of at most half of it");
  if (options.window > 0) return {options.window};
  std::vector<int> out;
  const double least = std::max<double>(kShortestWindow, options.min_secs * options.frames_per_sec);
  const double most = std::min<double>(longest / 2.0, options.max_secs * options.frames_per_sec);
  for (double length = least; length <= most + 0.5; length *= kLengthStep)
    out.push_back(static_cast<int>(std::lround(length)));
  return out;
}

/// Where whole actions stand in their windows is open as far as idle frames reach: in the middle.
int centring(const MotifSearch& search, const MotifSeed& seed) {
  if (!search.whole_only) return 0;
  std::vector<double> shifts;
  for (int k = 0; k < seed.count; ++k) {
    const Match& match = seed.matches[static_cast<std::size_t>(k)];
    shifts.push_back(search.action.off_centre(match.start, match.length));
  }
  const int shift = static_cast<int>(std::lround(quantile(std::move(shifts), 0.5)));
  for (int k = 0; k < seed.count; ++k) {
    const Match& match = seed.matches[static_cast<std::size_t>(k)];
    if (!search.frames.whole(match.start + shift, match.length)) return 0;
  }
  return shift;
}

Motif motif_of(const MotifSearch& search, const MotifSeed& seed) {
  const int shift = centring(search, seed);
  Motif motif;
  motif.window = seed.window;
  for (int k = 0; k < seed.count; ++k) {
    const Match& match = seed.matches[static_cast<std::size_t>(k)];
    motif.occurrences.push_back({match.start + shift, match.length, correlation_distance(match.correlation)});
  }
  motif.exemplar = motif.occurrences[0].start;
  motif.distance = motif.occurrences[1].distance;
  motif.radius = motif.occurrences.back().distance;
  std::sort(motif.occurrences.begin(), motif.occurrences.end(),
            [](const Occurrence& a, const Occurrence& b) { return a.start < b.start; });
  return motif;
}

/// What overlaps an occurrence of the motif is no longer there to be matched.
void drop_taken(MotifSeed& seed, const Motif& motif, const FindMotifsOptions& options) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < seed.matches.size(); ++k) {
    if (is_taken(motif.occurrences, seed.matches[k])) continue;
    seed.matches[kept] = seed.matches[k];
    seed.lambda[kept++] = seed.lambda[k];
  }
  if (kept == seed.matches.size()) return;
  seed.matches.resize(kept);
  seed.lambda.resize(kept);
  rate(seed, options);
}

std::string chance_words(double gain, double needed) {
  char text[120];
  std::snprintf(text, sizeof text, "not significant: −ln P of so many so alike by chance is %.1f, %.1f is needed", gain,
                needed);
  return text;
}

std::string overlap_words(const Motif& motif) {
  return "overlaps occurrences of the motif at frame " + std::to_string(motif.exemplar);
}

/// A motif that was found, with the pattern's other matches.
struct Accepted {
  Motif motif;
  std::vector<Match> others;
};

/// The motif that most occurrences of the seed lie within 2R of: it is no other action. [PT04] section 2.2
Accepted* same_action(std::vector<Accepted>& accepted, const MotifSeed& seed) {
  for (Accepted& known : accepted) {
    int near = 0;
    for (int k = 0; k < seed.count; ++k) {
      const Match& match = seed.matches[static_cast<std::size_t>(k)];
      const Occurrence place{match.start, match.length, 0};
      near += std::any_of(known.others.begin(), known.others.end(), [&](const Match& other) {
        return correlation_distance(other.correlation) <= 2 * known.motif.radius && overlaps(other, place);
      });
    }
    if (2 * near > seed.count) return &known;
  }
  return nullptr;
}

void join(Motif& motif, const Motif& more) {
  motif.occurrences.insert(motif.occurrences.end(), more.occurrences.begin(), more.occurrences.end());
  std::sort(motif.occurrences.begin(), motif.occurrences.end(),
            [](const Occurrence& a, const Occurrence& b) { return a.start < b.start; });
}

MotifCandidate candidate_of(const MotifSeed& seed, std::string reason) {
  MotifCandidate out;
  out.window = seed.window;
  out.distance = correlation_distance(seed.matches[1].correlation);
  for (int k = 0; k < seed.count; ++k) out.starts.push_back(seed.matches[static_cast<std::size_t>(k)].start);
  std::sort(out.starts.begin(), out.starts.end());
  out.reason = std::move(reason);
  return out;
}

/// The most significant first; each takes its frames.
void select(const MotifSearch& search, std::vector<MotifSeed>& seeds, double needed, std::vector<Accepted>& accepted,
            std::vector<MotifCandidate>& candidates) {
  const auto drop_everywhere = [&](const Motif& motif, const std::string& told = {}) {
    MotifSeed lost;  // the most significant pattern that this leaves without a second occurrence
    for (MotifSeed& seed : seeds) {
      if (seed.count <= 1) continue;
      const bool is_told = !told.empty() && seed.gain >= needed && seed.gain > lost.gain;
      MotifSeed before;
      if (is_told) before = seed;
      drop_taken(seed, motif, search.options);
      if (is_told && seed.count <= 1) lost = std::move(before);
    }
    if (lost.count > 1 && candidates.size() < kMostCandidates) candidates.push_back(candidate_of(lost, told));
  };
  for (const Accepted& known : accepted) drop_everywhere(known.motif, overlap_words(known.motif));
  while (true) {
    MotifSeed* best = nullptr;
    for (MotifSeed& seed : seeds)
      if (seed.count > 1 && (best == nullptr || seed.gain > best->gain)) best = &seed;
    if (best == nullptr) return;
    const MotifSeed seed = *best;
    best->count = 1;  // looked at
    Motif motif = motif_of(search, seed);
    if (seed.gain < needed) {
      if (candidates.size() >= kMostCandidates) return;
      candidates.push_back(candidate_of(seed, chance_words(seed.gain, needed)));
      drop_everywhere(motif);
      continue;
    }
    if (is_several(search, seed)) {
      if (candidates.size() < kMostCandidates)
        candidates.push_back(candidate_of(seed, "repeats within itself: one performance is shorter"));
      continue;
    }
    std::string told;
    if (Accepted* known = same_action(accepted, seed)) {
      told = overlap_words(known->motif);
      join(known->motif, motif);
    } else if (static_cast<int>(accepted.size()) >= search.options.max_motifs) {
      candidates.push_back(candidate_of(
          seed, "more than K = " + std::to_string(accepted.size()) + ": those found are more significant"));
      if (candidates.size() >= kMostCandidates) return;
    } else {
      accepted.push_back({motif, {seed.matches.begin() + seed.count, seed.matches.end()}});
      told = overlap_words(motif);
    }
    drop_everywhere(motif, told);
  }
}

}  // namespace

std::string motif_letter(int idx) {
  std::string out;
  for (int rest = idx; rest >= 0; rest = rest / 26 - 1) out.insert(out.begin(), static_cast<char>('A' + rest % 26));
  return out;
}

MotifReport find_motifs(const FrameMatrix& given, const FindMotifsOptions& options,
                        const std::vector<FrameSpan>& stretches, const JobContext& job) {
  check_options(options);
  FrameMatrix series = without_line(given);
  MotifReport report;
  report.windows = lengths(options, static_cast<int>(series.rows()));
  if (report.windows.empty()) return report;
  const int level_window = std::clamp(static_cast<int>(std::lround(kLevelSecs * options.frames_per_sec)),
                                      kShortestWindow, static_cast<int>(series.rows()));
  const Activity activity = find_activity(
      series, level_window, static_cast<int>(std::lround(kDriftSecs * options.frames_per_sec)), stretches);
  if (series.cols() > 1)  // made comparable, so that one deviation a window will do
    for (Index s = 0; s < series.cols(); ++s)
      if (const double scale = activity.scale[static_cast<std::size_t>(s)]; scale > 0) series.col(s) /= scale;
  MotifSearch search{
      series, options, stretches, job, ActionWindows(activity.active, level_window), PatternSearch(series, stretches)};
  std::vector<FrameSpan> active;
  for (std::size_t t = 0; t < activity.active.size(); ++t) {
    if (activity.active[t] == 0) continue;
    if (active.empty() || active.back().end() != static_cast<int>(t)) active.push_back({static_cast<int>(t), 0});
    ++active.back().length;
  }
  report.set.idle = activity.idle;
  std::vector<Accepted> accepted;
  for (const bool whole_only : {true, false}) {
    if (whole_only && !activity.two_levels) continue;
    search.whole_only = whole_only;
    double num_patterns = 1;
    std::vector<MotifSeed> seeds = motif_seeds(search, report.windows, active, num_patterns);
    report.candidates.clear();
    select(search, seeds, std::log(num_patterns / options.false_motifs), accepted, report.candidates);
  }
  for (Accepted& known : accepted) report.set.motifs.push_back(std::move(known.motif));
  refine_motifs(search, active, report.set.motifs);
  std::stable_sort(report.set.motifs.begin(), report.set.motifs.end(),
                   [](const Motif& a, const Motif& b) { return a.occurrences.size() > b.occurrences.size(); });
  for (std::size_t k = 0; k < report.set.motifs.size(); ++k)
    report.set.motifs[k].letter = motif_letter(static_cast<int>(k));
  return report;
}

}  // namespace motex
