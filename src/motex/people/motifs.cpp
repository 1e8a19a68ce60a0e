// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/motifs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/quantile.h"
#include "motex/people/activity.h"
#include "motex/people/motif_refine.h"
#include "motex/people/motif_seeds.h"
#include "motex/people/motif_selection.h"
#include "motex/people/trend.h"

namespace motex {
namespace {

constexpr int kShortestWindow = 4;
constexpr double kLengthStep = 1.12;
constexpr double kLevelSecs = 0.8;
constexpr double kDriftSecs = 5;

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

/// Who holds still in the midst of an action performs it.
std::vector<FrameSpan> outside_actions(std::vector<FrameSpan> idle, const std::vector<Motif>& motifs) {
  std::erase_if(idle, [&](const FrameSpan& span) {
    return std::any_of(motifs.begin(), motifs.end(), [&](const Motif& motif) {
      return std::any_of(motif.occurrences.begin(), motif.occurrences.end(), [&](const Occurrence& one) {
        return one.start <= span.start && span.end() <= one.start + one.length;
      });
    });
  });
  return idle;
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
  std::vector<double> level = activity.brief_level;
  for (double& value : level)
    if (value >= 0) value *= series.cols() > 1 ? std::sqrt(static_cast<double>(series.cols())) : activity.scale[0];
  MotifSearch search{series,
                     options,
                     stretches,
                     job,
                     ActionWindows(activity.active, level_window),
                     PatternSearch(series, stretches),
                     MotifCode(series, level, level_window)};
  std::vector<FrameSpan> active;
  for (std::size_t t = 0; t < activity.active.size(); ++t) {
    if (activity.active[t] == 0) continue;
    if (active.empty() || active.back().end() != static_cast<int>(t)) active.push_back({static_cast<int>(t), 0});
    ++active.back().length;
  }
  std::vector<SelectedMotif> selected;
  for (const bool whole_only : {true, false}) {
    if (whole_only && !activity.two_levels) continue;
    search.whole_only = whole_only;
    double num_patterns = 1;
    std::vector<MotifSeed> seeds = motif_seeds(search, report.windows, active, num_patterns);
    report.candidates.clear();
    select_motifs(search, seeds, std::log(num_patterns / options.false_motifs), selected, report.candidates);
  }
  for (SelectedMotif& known : selected) report.set.motifs.push_back(std::move(known.motif));
  refine_motifs(search, active, report.set.motifs);
  report.set.idle = outside_actions(activity.idle, report.set.motifs);
  std::stable_sort(report.set.motifs.begin(), report.set.motifs.end(),
                   [](const Motif& a, const Motif& b) { return a.occurrences.size() > b.occurrences.size(); });
  for (std::size_t k = 0; k < report.set.motifs.size(); ++k)
    report.set.motifs[k].letter = motif_letter(static_cast<int>(k));
  return report;
}

}  // namespace motex
