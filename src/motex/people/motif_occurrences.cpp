// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/motif_occurrences.h"

#include <algorithm>
#include <cstddef>

namespace motex {

Occurrence within_take(const MotifSearch& search, const Occurrence& one) {
  if (whole(search, one)) return one;
  const int from = std::max(0, one.start), to = std::min(one.start + one.length, search.frames.num_frames());
  int start = middle(one), end = start;
  while (start > from && search.frames.whole(start - 1, end - start + 1)) --start;
  while (end < to && search.frames.whole(start, end - start + 1)) ++end;
  return {start, end - start, one.distance};
}

bool is_free(const MotifSearch& search, const std::vector<Occurrence>& occurrences, const Occurrence& place) {
  const Occurrence seen = within_take(search, place);
  return std::none_of(occurrences.begin(), occurrences.end(),
                      [&](const Occurrence& o) { return overlaps(seen, within_take(search, o)); });
}

bool is_free(const MotifSearch& search, const std::vector<Motif>& motifs, const Occurrence& place) {
  return std::all_of(motifs.begin(), motifs.end(),
                     [&](const Motif& motif) { return is_free(search, motif.occurrences, place); });
}

Pattern mean_of(const MotifSearch& search, const std::vector<Occurrence>& all, int window) {
  Pattern sum = Pattern::Zero(window, search.series.cols());
  for (const Occurrence& one : all)
    if (whole(search, one)) sum += search.frames.pattern(one.start, one.length, window);
  return stretched(sum, window);
}

void align(const MotifSearch& search, Motif& motif) {
  const Pattern mean = mean_of(search, motif.occurrences, motif.window);
  for (Occurrence& one : motif.occurrences) {
    const Match match = search.frames.closest(mean, middle(one), std::max(2, motif.window / 10));
    if (match.length > 0) one.start = match.start, one.length = match.length;
  }
}

std::vector<double> correlations(const MotifSearch& search, const Motif& motif) {
  Pattern sum = Pattern::Zero(motif.window, search.series.cols());
  std::vector<Pattern> own;
  for (const Occurrence& one : motif.occurrences) {
    const bool known = whole(search, one);
    own.push_back(known ? search.frames.pattern(one.start, one.length, motif.window)
                        : Pattern::Zero(motif.window, search.series.cols()));
    sum += own.back();
  }
  std::vector<double> out;
  for (std::size_t k = 0; k < own.size(); ++k)
    out.push_back(whole(search, motif.occurrences[k]) ? own[k].cwiseProduct(stretched(sum - own[k], motif.window)).sum()
                                                      : -1);
  return out;
}

double spread(const MotifSearch& search, const Motif& motif) {
  double sum = 0, count = 0;
  for (const double correlation : correlations(search, motif))
    if (correlation > -1) sum += 2 * (1 - correlation), count += 1;
  return count > 0 ? sum / count : 2;
}

}  // namespace motex
