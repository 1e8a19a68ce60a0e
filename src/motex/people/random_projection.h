// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/people/motif.h"
#include "motex/people/series_windows.h"

namespace motex {

/// One entry of the collision matrix, above the diagonal.
struct Collision {
  int row = 0, column = 0;  ///< first windows of two runs of equal words, row < column
  int count = 0;            ///< masks under which their words are equal
};

struct RandomProjectionOptions {
  int word_length = 16;
  int alphabet = 6;
  int mask_size = 6;
  int iterations = 40;
  double radius = 0;
  int max_motifs = 10;
  std::uint64_t seed = 1;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"word_length", "letters", "of a window's word"}, self.word_length, Range{2, 64});
    visit(Field{"alphabet", "letters", "to choose from"}, self.alphabet, Range{2, 20});
    visit(Field{"mask_size", "letters", "compared in an iteration"}, self.mask_size, Range{1, 12});
    visit(Field{"iterations", "", "of random projection"}, self.iterations, Range{1, 10000});
    visit(
        Field{"radius", "", "R, Euclidean between z-normalised windows / √window; auto = twice the closest pair found"},
        self.radius, Range{0.001, 2, true});
    visit(Field{"max_motifs", "", "K"}, self.max_motifs, Range{1, 1000});
    visit(Field{"seed", "", "of the random masks"}, self.seed, Range{0, 1e18});
  }
};

struct RandomProjectionReport {
  std::vector<Motif> motifs;                       ///< by number of non-trivial matches
  std::vector<std::vector<Collision>> collisions;  ///< after a quarter, half and all iterations: Figure 2
  int first = -1, second = -1;                     ///< closest pair found
  double distance = 0;                             ///< of it, / √window
  double radius = 0;                               ///< R, / √window
  int num_compared = 0;                            ///< pairs whose distance was computed
};

/// Motifs by random projection of symbolic words [Chiu, Keogh, Lonardi 2003], the black box of [PT04] section 2.2:
/// windows whose words agree under a random mask collide; pairs that collide most are compared in full. Runs of windows
/// with one word count once (their first window), and windows less than one window apart are trivial matches that never
/// collide. The pairs of most collisions are tried, each within a quarter of a window around, until as many in a row as
/// were tried before bring nothing closer. A motif is the window with most non-trivial matches within R; the next ones
/// lie more than 2R from all before. Uses the first signal.
RandomProjectionReport random_projection_motifs(const SeriesWindows& windows,
                                                const RandomProjectionOptions& options = {},
                                                const JobContext& job = {});

/// The same definition by comparing every window with every other: the test's oracle. Cost windows² · m.
std::vector<Motif> exhaustive_motifs(const SeriesWindows& windows, double radius, int max_motifs);

}  // namespace motex
