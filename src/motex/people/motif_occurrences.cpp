// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/motif_occurrences.h"

#include <algorithm>

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

}  // namespace motex
