// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/motion/clip.h"
#include "motex/motion_texture/model.h"

namespace motex {

struct LearnReport {
  Index num_frames = 0;         ///< learned from
  Index num_glitch_frames = 0;  ///< left out
  int num_clips = 0;
  int num_textons = 0;
  int num_segments = 0;
  int state_size = 0;
  double threshold = 0;  ///< used
  /// The objective after every EM iteration, nats: log-likelihood of the frames and texton path
  /// + log prior of the dynamics + log prior of the transition matrix + the moves' paths. Never falls.
  std::vector<double> objective;
  bool converged = false;
  int num_dead_ends = 0;         ///< textons without an observed successor, before jumps were added
  int num_components = 0;        ///< strongly connected components, jumps added
  double largest_component = 0;  ///< share of textons in the largest one
};

/// Learns textons and their distribution [MT02 4]. Clips: one skeleton, one frame rate (see unify_clips), each long
/// enough for one segment. Throws InvalidInput when nothing is long enough, Cancelled.
MotionTexture learn_motion_texture(std::span<const Clip> clips, const LearnOptions& options, LearnReport& report,
                                   const JobContext& job = {});

/// A stretch of a clip recognised as a texton.
struct RecognisedSegment {
  int texton = 0;
  Index start = 0, length = 0;
  double log_likelihood_per_frame = 0;
};

/// The most likely segmentation of a clip that may be new to the model [MT02 appendix A], by dynamics, transitions and,
/// where the model was learned with them, the paths of moves.
std::vector<RecognisedSegment> segment_clip(const MotionTexture& model, const Clip& clip);

/// Nats per frame of the weighted feature vector: a density of each frame given those before it, so the paths of moves,
/// which look ahead, have no part in it. Counted are the frames that two good frames precede; glitches are
/// left out as in learning.
struct ScoreReport {
  double log_likelihood_per_frame = 0;             ///< of clips and their best texton path
  double global_lds_log_likelihood_per_frame = 0;  ///< of the clips under one global LDS of the same state size
  Index num_frames = 0;
};
ScoreReport score_clips(const MotionTexture& model, std::span<const Clip> clips, const JobContext& job = {});

}  // namespace motex
