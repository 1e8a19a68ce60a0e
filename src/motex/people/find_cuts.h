// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/people/compare_silhouettes.h"
#include "motex/people/people_texture.h"

namespace motex {

struct FindCutsOptions {
  double min_jump_secs = 0.5;
  double max_smoothness = 1.5;
  double max_difference = 0;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"min_jump_secs", "s", "a cut within a take leaps at least that far"}, self.min_jump_secs,
          Range{0.1, 60});
    visit(Field{"max_smoothness", "",
                "largest second difference of area, centroid and aspect over a cut, against its 95th percentile in the "
                "footage"},
          self.max_smoothness, Range{0.1, 10});
    visit(Field{"max_difference", "grey levels",
                "largest difference of the pictures, root mean square over two frames; auto: 1.5 times what a frame "
                "differs from the next where the actor is quick (95th percentile), 20 at least"},
          self.max_difference, Range{0.1, 255, true});
  }
};

struct FindCutsReport {
  CutSet cuts;
  double max_difference = 0;        ///< that was used
  std::int64_t num_compared = 0;    ///< pairs of frames whose masks were compared
  std::int64_t num_candidates = 0;  ///< cuts whose pictures were compared
};

/// All good cuts of a people texture: film may go from frame i to frame j when i is like j − 1 and i + 1 like j, two
/// consecutive frames of one person as in [PT04] section 3.1, so that the movement agrees in place and in direction.
/// Masks come first (hamming distance at most an eighth of the cells), then of each 16 × 16 pairs of frames the best
/// cut each way by masks and smoothness is looked at in pictures, with its neighbours, and kept when it passes both
/// limits. So of many alike one in 16 × 16 is left. Never from or to a frame whose neighbours are in another take or
/// show nobody. Mirrored takes take part like any other. Throws InvalidInput when takes, silhouettes and pictures
/// disagree.
FindCutsReport find_cuts(const PeopleTexture& texture, const ComparableFrames& frames,
                         const FindCutsOptions& options = {}, const JobContext& job = {});

/// √((ξ_{i,j−1} + ξ_{i+1,j}) / 2) in grey levels, the difference of a cut.
double cut_difference(const SilhouettePictures& pictures, int from, int to);

}  // namespace motex
