// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/motion_texture/choreograph.h"
#include "motex/motion_texture/gap_examples.h"

namespace motex {

struct LoopReport {
  ClipFrame start;                          ///< frame 0 is this one
  std::vector<ChoreographedTexton> played;  ///< in frames of the loop; the last one leads into frame 0
  double cost = 0;
  /// At the seam, frame 0 following the last: largest second difference of a joint's position over one frame, against
  /// the largest inside the loop.
  double seam_ratio = 0;
};

/// num_frames frames of which the first follows the last: a choreography from a pose to itself [MT02 5.2]. With `step`
/// (0, 0, 0) the loop stays in place; otherwise each round begins one step farther, seen from where it began. Of 24
/// key poses drawn with the seed, the one is taken from which a way back costs least, leads nearest to where it should,
/// and is as lively as the examples; the way of the root is bent so that it ends exactly there (bend_root_path).
/// Planted feet are held in a round between two others, so across the seam. Throws InvalidInput when no loop of that
/// many frames is found, naming the nearest number.
Clip synthesize_loop(const MotionTexture& model, Index num_frames, const RootStep& step,
                     const ChoreographyOptions& options, LoopReport& report, const JobContext& job = {});

/// A loop played `rounds` times, each round one step on.
Clip repeat_loop(const FeatureSpace& space, const Clip& loop, const RootStep& step, int rounds);

/// A loop played `speed` times as fast: round(frames / speed) frames.
Clip loop_at_speed(const FeatureSpace& space, const Clip& loop, const RootStep& step, double speed);

}  // namespace motex
