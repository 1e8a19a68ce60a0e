// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/core/matrix.h"
#include "motex/people/motifs.h"
#include "motex/people/people_texture.h"
#include "motex/people/random_projection.h"

namespace motex {

/// Random projection of windows of one length, beside what is exact.
struct PaperSearch {
  int window = 0;       ///< frames
  int num_windows = 0;  ///< of the series
  RandomProjectionReport found;
  double exact = 0;  ///< distance of the closest pair of windows at least one window apart, / √window

  /// Distance of the closest cell of the collision matrix over the exact one; 1 when both are 0, NaN when there is no
  /// pair.
  double matrix_over_exact() const { return over_exact(found.in_matrix); }
  /// The same after the search around the cells.
  double closest_over_exact() const { return over_exact(found.closest); }

 private:
  double over_exact(const WindowPair& pair) const;
};

struct PaperMotifReport {
  std::vector<PaperSearch> searches;       ///< of every length
  MotifSet set;                            ///< of all lengths, by number of occurrences; idle stays empty
  std::vector<MotifCandidate> candidates;  ///< of all lengths
};

/// The motifs as the paper has them: random_projection_motifs() for windows of 40, 80 and 160 frames (options.window:
/// for one length), at most ten of each. Of the options window, radius and max_motifs count. Throws InvalidInput: more
/// than one column, too short for two windows of 40 frames. [PT04] section 2.2
PaperMotifReport find_paper_motifs(const FrameMatrix& series, const FindMotifsOptions& options = {},
                                   const std::vector<FrameSpan>& stretches = {}, const JobContext& job = {});

/// The same of footage: of the aspect ratio, inside takes.
PaperMotifReport find_paper_motifs(const PeopleTexture& texture, const FindMotifsOptions& options = {},
                                   const JobContext& job = {});

}  // namespace motex
