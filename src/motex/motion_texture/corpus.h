// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "motex/core/job.h"
#include "motex/motion_texture/model.h"

namespace motex {

/// The examples as one table: weighted features of the runs of good frames, one after another.
struct Corpus {
  FrameMatrix features;  ///< frames × D
  std::vector<Run> runs;
  Index num_glitch_frames = 0;
};

/// Encodes the clips, leaves glitch frames out (said through the job) and keeps runs of at least min_frames + 2 frames.
/// Throws InvalidInput when none is that long.
Corpus make_corpus(const FeatureSpace& space, std::span<const Clip> clips, Index min_frames, bool keep_glitches,
                   const JobContext& job);

/// Consecutive frames labelled with one texton; segments of a run follow one another without gap.
struct LabelledSegment {
  int texton = 0;
  int run_idx = 0;
  Index row = 0;
  Index length = 0;
};
using Segmentation = std::vector<LabelledSegment>;

/// Median distance in cm between the features of frames drawn at random.
double random_pose_distance(const Corpus& corpus, std::uint64_t seed);

}  // namespace motex
