// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/particles/element_filter.h"

namespace motex {

struct LinkSightsOptions {
  int width = 0, height = 0;  ///< of the picture; 0 = unknown: the extent of the sights
  int max_gap = 6;            ///< frames in a row in which an element may go unseen
  int sweeps = 4;
};

/// A path through the sights: indices into the frames, rising frames.
struct SightChain {
  std::vector<Sight> sights;
  std::vector<int> idx;   ///< of each in its frame
  double confidence = 1;  ///< probability that none of its links is wrong
};

struct LinkedSights {
  std::vector<SightChain> chains;  ///< single sights too; in order of first frame and index there
  ElementModel model;              ///< as learned
  double expected_wrong_share = 0;
  int num_links = 0;
};

/// Links that maximise Σ over paths of ln p(path), from `start` as first model of the elements. At each cut between two
/// frames the paths that end before it and those that begin after it are joined again in the best way (best_pairs,
/// exact), where the likelihood of a join takes the last ten sights before the cut and the first five after it; cut
/// after cut, sweep after sweep until no link changes; the model is fitted again after each sweep. frames[t][i].frame
/// must be t. Throws Cancelled.
LinkedSights link_sights(const std::vector<std::vector<Sight>>& frames, const ElementModel& start,
                         const LinkSightsOptions& options, const JobContext& job = {});

}  // namespace motex
