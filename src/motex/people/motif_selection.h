// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/people/motif_seeds.h"
#include "motex/people/motifs.h"

namespace motex {

/// A motif that was found, with the pattern's other matches.
struct SelectedMotif {
  Motif motif;
  std::vector<Match> others;
};

/// Which patterns are motifs: of those whose gain is at least `needed` the one that saves most (MotifCode) takes its
/// frames, then the next of what is left (where the window is told, the one of most gain). That may end in a long
/// pattern that took the place of several shorter ones; so each motif is once forbidden, with all patterns at its
/// places that are nearly as long, and what is chosen then stays when all together saves more. Adds to what was
/// selected before, whose frames are taken.
void select_motifs(const MotifSearch& search, const std::vector<MotifSeed>& seeds, double needed,
                   std::vector<SelectedMotif>& selected, std::vector<MotifCandidate>& candidates);

}  // namespace motex
