// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/motif_join.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "motex/people/motif_occurrences.h"

namespace motex {
namespace {

constexpr double kHoldSecs = 1.2;
constexpr double kMayOverlap = 0.25;  // of the first part
constexpr std::size_t kLeastPairs = 3;

/// Performances of one motif that another one follows at once.
struct Followed {
  Motif first, second, both;  ///< occurrences: of the pairs, in the same order
};

Followed followed(const MotifSearch& search, const Motif& a, const Motif& b) {
  const int longest_hold = static_cast<int>(kHoldSecs * search.options.frames_per_sec);
  Followed out{a, b, a};
  for (Motif* motif : {&out.first, &out.second, &out.both}) motif->occurrences.clear();
  double frames = 0;
  for (const Occurrence& x : a.occurrences) {
    for (const Occurrence& y : b.occurrences) {
      const int gap = y.start - x.start - x.length;
      if (gap < -kMayOverlap * x.length || gap > longest_hold) continue;
      const Occurrence both{x.start, y.start + y.length - x.start, 0};
      if (!whole(search, both) || !whole(search, x) || !whole(search, y)) continue;
      out.first.occurrences.push_back(x);
      out.second.occurrences.push_back(y);
      out.both.occurrences.push_back(both);
      frames += both.length;
      break;
    }
  }
  if (frames > 0)
    out.both.window = static_cast<int>(std::lround(frames / static_cast<double>(out.both.occurrences.size())));
  return out;
}

/// By saying every performance as its likeness to the others.
double saved_by(const MotifSearch& search, const Motif& motif) {
  const std::vector<double> correlation = correlations(search, motif);
  double sum = 0;
  for (std::size_t k = 0; k < correlation.size(); ++k) {
    const Occurrence& one = motif.occurrences[k];
    if (whole(search, one)) sum += search.code.saved(one.start, one.length, correlation[k]);
  }
  return sum;
}

bool is_one_action(const MotifSearch& search, const Motif& a, const Motif& b, Followed& pairs) {
  const std::size_t n = pairs.both.occurrences.size(), most = std::max(a.occurrences.size(), b.occurrences.size());
  if (n < kLeastPairs || 3 * n < 2 * most) return false;
  align(search, pairs.both);
  return 1 - spread(search, pairs.both) / 2 >= kAgree &&
         saved_by(search, pairs.both) > saved_by(search, pairs.first) + saved_by(search, pairs.second);
}

}  // namespace

bool join_parts(const MotifSearch& search, std::vector<Motif>& motifs) {
  for (std::size_t i = 0; i < motifs.size(); ++i) {
    for (std::size_t j = 0; j < motifs.size(); ++j) {
      if (i == j) continue;
      Followed pairs = followed(search, motifs[i], motifs[j]);
      if (!is_one_action(search, motifs[i], motifs[j], pairs)) continue;
      motifs[i] = std::move(pairs.both);
      motifs.erase(motifs.begin() + static_cast<std::ptrdiff_t>(j));
      return true;
    }
  }
  return false;
}

}  // namespace motex
