// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/paper_motifs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/people/footage_motifs.h"
#include "motex/people/matrix_profile.h"
#include "motex/people/series_windows.h"
#include "motex/people/signals.h"

namespace motex {
namespace {

constexpr int kWindows[] = {40, 80, 160};
constexpr int kMostOfALength = 10;

PaperSearch search_of(const SeriesWindows& windows, const FindMotifsOptions& options, const JobContext& job) {
  RandomProjectionOptions projection;
  projection.radius = options.radius;
  projection.max_motifs = std::min(options.max_motifs, kMostOfALength);
  PaperSearch search{windows.window, windows.num_windows, random_projection_motifs(windows, projection, job), 0};
  const MatrixProfile profile = matrix_profile(windows, windows.window - 1, job);
  search.exact = *std::min_element(profile.distance.begin(), profile.distance.end()) /
                 std::sqrt(static_cast<double>(windows.window));
  return search;
}

}  // namespace

double PaperSearch::over_exact(const WindowPair& pair) const {
  if (pair.first < 0) return std::numeric_limits<double>::quiet_NaN();
  return pair.distance == exact ? 1 : pair.distance / exact;
}

PaperMotifReport find_paper_motifs(const FrameMatrix& series, const FindMotifsOptions& options,
                                   const std::vector<FrameSpan>& stretches, const JobContext& job) {
  check_options(options);
  if (series.cols() != 1) throw InvalidInput("the paper's search takes one signal: choose one");
  std::vector<int> lengths(std::begin(kWindows), std::end(kWindows));
  if (options.window > 0) lengths = {options.window};
  PaperMotifReport report;
  for (const int window : lengths) {
    if (2 * window > series.rows()) continue;
    report.searches.push_back(search_of(series_windows(series, window, stretches), options, job));
    const RandomProjectionReport& found = report.searches.back().found;
    report.set.motifs.insert(report.set.motifs.end(), found.motifs.begin(), found.motifs.end());
    report.candidates.insert(report.candidates.end(), found.candidates.begin(), found.candidates.end());
  }
  if (report.searches.empty())
    throw InvalidInput("too short for two windows of " + std::to_string(lengths[0]) +
                       " frames: say a shorter --window");
  std::stable_sort(report.set.motifs.begin(), report.set.motifs.end(),
                   [](const Motif& a, const Motif& b) { return a.occurrences.size() > b.occurrences.size(); });
  for (std::size_t k = 0; k < report.set.motifs.size(); ++k)
    report.set.motifs[k].letter = motif_letter(static_cast<int>(k));
  return report;
}

PaperMotifReport find_paper_motifs(const PeopleTexture& texture, const FindMotifsOptions& options,
                                   const JobContext& job) {
  const MotifSignals signals = paper_motif_signals(texture);
  return find_paper_motifs(motif_series(signals), options, signals.stretches, job);
}

}  // namespace motex
