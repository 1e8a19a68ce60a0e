// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/people/motif_seeds.h"

namespace motex {

inline int middle(const Occurrence& one) { return one.start + one.length / 2; }

/// All frames are of one take. An occurrence that is not whole counts from where it would begin to where it would end.
inline bool whole(const MotifSearch& search, const Occurrence& one) {
  return search.frames.whole(one.start, one.length);
}

/// What the ends of the take that holds the middle leave of it.
Occurrence within_take(const MotifSearch& search, const Occurrence& one);

/// What is seen of the place is in the way of nothing that is seen of the occurrences.
bool is_free(const MotifSearch& search, const std::vector<Occurrence>& occurrences, const Occurrence& place);
bool is_free(const MotifSearch& search, const std::vector<Motif>& motifs, const Occurrence& place);

/// Of what is whole, in `window` rows.
Pattern mean_of(const MotifSearch& search, const std::vector<Occurrence>& all, int window);

/// Every occurrence is laid anew on the mean of all.
void align(const MotifSearch& search, Motif& motif);

/// Of every occurrence with the mean of the others; −1 where it is not whole.
std::vector<double> correlations(const MotifSearch& search, const Motif& motif);

/// Mean squared distance of what is whole.
double spread(const MotifSearch& search, const Motif& motif);

}  // namespace motex
