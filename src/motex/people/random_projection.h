// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/people/collision_matrix.h"
#include "motex/people/motifs.h"
#include "motex/people/series_windows.h"

namespace motex {

struct RandomProjectionOptions {
  int word_length = 32;
  int alphabet = 0;
  int mask_size = 6;
  int iterations = 100;
  double radius = 0;
  int max_motifs = 10;
  std::uint64_t seed = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"word_length", "letters", "of a window's word"}, self.word_length, Range{2, 64});
    visit(Field{"alphabet", "letters",
                "to choose from; auto = 16, halved down to 4 as long as fewer than 1,000 pairs of windows collide"},
          self.alphabet, Range{2, 20, true});
    visit(Field{"mask_size", "letters", "compared in an iteration"}, self.mask_size, Range{1, 12});
    visit(Field{"iterations", "", "of random projection"}, self.iterations, Range{1, 10000});
    visit(
        Field{"radius", "", "R, Euclidean between z-normalised windows / √window; auto = twice the closest pair found"},
        self.radius, Range{0.001, 2, true});
    visit(Field{"max_motifs", "", "K"}, self.max_motifs, Range{1, 1000});
    visit(Field{"seed", "", "of the random masks"}, self.seed, Range{0, 1e18});
  }
};

/// Two windows that resemble one another.
struct WindowPair {
  int first = -1, second = -1;  ///< starts; −1 = none
  double distance = 0;          ///< / √window
};

struct RandomProjectionReport {
  std::vector<Motif> motifs;                ///< by number of non-trivial matches
  std::vector<MotifCandidate> candidates;   ///< refused, one a place, at most ten
  std::vector<CollisionMatrix> collisions;  ///< after a quarter, half and all iterations: Figure 2
  WindowPair in_matrix;                     ///< the closest of the cells that collide most, as they stand
  WindowPair closest;                       ///< the closest around the closest of these
  double radius = 0;                        ///< R, / √window
  int alphabet = 0;                         ///< letters
  int num_compared = 0;                     ///< pairs whose distance was computed to find the closest
};

/// Motifs by random projection of symbolic words [Chiu, Keogh, Lonardi 2003], the black box of [PT04] section 2.2: the
/// pairs of windows that collide most (count_collisions(), ranked_cells()) are compared in full, 1,000 and on until as
/// many again bring nothing closer; around the 20 closest of them the neighbours are tried too, since a run of equal
/// words is one cell. A motif is the window with most non-trivial matches within R among the 300 in which the most
/// collisions end; the next ones lie more than 2R from all before and share at most half of their frames with an
/// occurrence of these (the same action a little later often lies beyond 2R). Uses the first signal.
RandomProjectionReport random_projection_motifs(const SeriesWindows& windows,
                                                const RandomProjectionOptions& options = {},
                                                const JobContext& job = {});

/// The same definition by comparing every window with every other: the test's oracle. Cost windows² · m.
std::vector<Motif> exhaustive_motifs(const SeriesWindows& windows, double radius, int max_motifs);

}  // namespace motex
