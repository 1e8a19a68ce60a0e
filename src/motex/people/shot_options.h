// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/core/options.h"

namespace motex {

/// How a film is cut, directed or freely played.
struct ShotOptions {
  int transition_frames = 5;
  double min_shot_secs = 0.4;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"transition_frames", "frames", "length of the morph at a cut; 0: hard cuts"}, self.transition_frames,
          Range{0, 100});
    visit(Field{"min_shot_secs", "s", "shortest time between two cuts"}, self.min_shot_secs, Range{0.04, 60});
  }
};

/// Frames between two cuts: min_shot_secs, and room for the transitions at both ends.
int min_shot_frames(const ShotOptions& options, double frames_per_sec);

}  // namespace motex
