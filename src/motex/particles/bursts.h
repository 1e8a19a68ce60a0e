// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "motex/core/options.h"
#include "motex/particles/birth_death.h"
#include "motex/particles/cable.h"
#include "motex/particles/moveton_template.h"

namespace motex {

struct FindBurstsOptions {
  int min_cables = 8;
  double max_delay = 12;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"min_cables", "", "births that make a burst"}, self.min_cables, Range{3, 10000});
    visit(Field{"max_delay", "frames", "longest time between a burst and the first sight of its elements"},
          self.max_delay, Range{0, 1000});
  }
};

/// Elements born together (a firework), which [TM02] section 3 asks joint probabilities for, by rising time.
///
/// The beginning of each cable is carried back in time along its path; where and when many paths come from many sides
/// to one point, there was a burst: o + (t_i − τ) v_i = x_i for origin o and time τ, linear in both, by robust least
/// squares over the cables that agree. What chance lets meet (parallel paths, a dense source) is no burst.
std::vector<Burst> find_bursts(std::span<const Cable> cables, const FindBurstsOptions& options = {});

/// How bursts look, over all of them: what synthesis draws from.
struct BurstStatistics {
  Spread num_cables;          ///< a burst
  Spread speed;               ///< pixels a frame, of its elements at their first sight
  double speed_between = 0;   ///< deviation of a burst's mean speed from burst to burst
  Spread life;                ///< frames, of cables that were seen to die
  Spread delay;               ///< frames from the burst to the first sight of an element
  double angle_coverage = 0;  ///< share of the directions that its elements fill, in 12 sectors, 0 … 1
};
BurstStatistics burst_statistics(std::span<const Burst> bursts, std::span<const Cable> cables, std::int64_t num_frames);

}  // namespace motex
