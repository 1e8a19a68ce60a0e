// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/motion_texture/beats.h"
#include "motex/motion_texture/loop.h"
#include "motex/motion_texture/synthesize.h"

namespace motex {

/// Play speeds: how many times as fast as the examples.
constexpr double kSlowestPlay = 0.25, kFastestPlay = 4;

struct DanceRequest {
  Index num_frames = 0;   ///< of what comes out; 0: as long as the path lasts
  std::vector<int> path;  ///< textons to play first
  double speed = 1;       ///< kSlowestPlay … kFastestPlay
  bool is_loop = false;
  RootStep step = RootStep::Zero();  ///< of a loop, by round
};

struct Dance {
  Clip clip;
  SynthesizeReport report;  ///< in frames of the clip
  BeatReport beats;         ///< where there are beats, in frames of the clip
  double seam_ratio = 0;    ///< of a loop (LoopReport)
  std::uint64_t seed = 0;
};

/// synthesize_motion or synthesize_loop, then played at a speed: the feet are held at the examples' own pace, and the
/// frames between are read off a cubic, so that what stands goes on standing. Beats are of the clip that comes out.
/// Throws InvalidInput for a speed out of range, and for a loop with a path or beats.
Dance make_dance(const MotionTexture& model, const DanceRequest& request, const SynthesizeOptions& options,
                 const JobContext& job = {});

/// Dances with seeds options.seed, options.seed + 1, …, made at the same time; the same for any number of threads.
std::vector<Dance> make_dances(const MotionTexture& model, const DanceRequest& request,
                               const SynthesizeOptions& options, int count, const JobContext& job = {});

}  // namespace motex
