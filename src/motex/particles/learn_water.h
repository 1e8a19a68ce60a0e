// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/particles/carry_bases.h"
#include "motex/particles/clip_frames.h"
#include "motex/particles/textured_motion.h"

namespace motex {

struct LearnWaterOptions {
  int num_bases = 0;
  bool steady = true;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"num_bases", "", "bases in each frame of water; auto: until they show 85 % of what moves, 200 … 3200"},
          self.num_bases, Range{1, 100000, true});
    visit(Field{"steady", "", "take the motion of the camera out first"}, self.steady, Range{});
  }
};

struct LearnedWater {
  TexturedMotion model;  ///< with `water`; its cables are carried bases without species
  CarryReport carry;
  int num_bases = 0;  ///< a frame
  double light = 0;   ///< deviation of what bases leave, grey levels (luma)
};

/// Whether the motion of a clip is water rather than elements that can be told apart: light that goes up and down all
/// the time and not when something passes. Σ m₄ / Σ m₂² over the pixels (moments over time, m₂² the weight) is 2.3–4.3
/// for water, 6.6–95 for snow, birds and sparks; and no third of the clip moves much less than another (a single
/// firework does). Noise is not water: neighbouring pixels of water correlate by .7–.98, those of sparse snow that
/// noise hides by .02. Of fewer than 30 frames nothing is said: false.
bool looks_like_water(const ClipFrames& clip, const JobContext& job = {});

/// Learns falling water, whose elements cannot be told apart: steadied frames over their mean, bases carried forward in
/// time along a flow field, a spatio-temporal autoregression of what they leave. The model's picture is that of the
/// steadied clip: a little smaller where the camera moved (a warning says so).
/// Throws InvalidInput (fewer than 12 frames), Cancelled.
LearnedWater learn_water(const ClipFrames& clip, const LearnWaterOptions& options = {}, const JobContext& job = {});

}  // namespace motex
