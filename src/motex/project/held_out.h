// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/motion_texture/learn.h"

namespace motex {

/// Clips to learn from and clips that learning must not see.
struct HeldOutSplit {
  std::vector<Clip> training, held_out;
};

/// Of the clips sorted by name, every fourth (of fewer than four: one) is held out, counted back from the last;
/// split 0, 1, 2, … moves the choice by one. A single clip is cut into quarters: quarter 3 − split is held out, the
/// rest is learned from. Throws InvalidInput without clips.
HeldOutSplit split_clips(std::vector<Clip> clips, int split = 0);

/// How well clips that were not learned from are predicted, nats per frame.
struct HeldOutReport {
  double log_likelihood_per_frame = 0;
  double global_lds_log_likelihood_per_frame = 0;  ///< of one linear dynamic system of the same state size
  /// Of the control: textons that share one dynamics and differ in noise alone (LearnOptions::common_dynamics). What
  /// the textons gain over it is gained by knowing where motion goes, not how unsteady it is.
  double noise_only_log_likelihood_per_frame = 0;
  Index num_frames = 0;  ///< scored
  std::vector<std::string> held_out_clips;
  LearnReport learned;
};

/// Learns on one part of a split, scores the other, and does the same for the control.
HeldOutReport held_out_score(std::vector<Clip> clips, int split, const LearnOptions& options,
                             const JobContext& job = {});

}  // namespace motex
