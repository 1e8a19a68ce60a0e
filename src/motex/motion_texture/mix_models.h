// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/motion_texture/model.h"

namespace motex {

struct MixReport {
  std::vector<int> textons_of_a, textons_of_b;  ///< the mixed model's number of each; −1: dropped or merged there
  int num_crossings = 0;                        ///< transitions that lead from one model's textons to the other's
  double crossing_distance = 0;  ///< median over examples, cm, from where one ends to the nearest of the other model
  double usual_distance = 0;     ///< the same to the nearest stranger of its own model
};

/// One model of two, each with its edits applied: the textons of both, side by side.
///
/// The frames of both are decoded, brought to one skeleton (unify_clips) and encoded in one new feature space;
/// subspaces are found and every texton is fitted anew, from its own segments, with the prior of both corpora together.
/// Transitions are those of both, weights included, and jumps of weight 0.3 from each example to the nearest one of the
/// other model. Options are those of a; the basis is each texton's own only if it is so in both. Names become edits of
/// the new model.
///
/// Throws InvalidInput when the skeletons differ, naming the first joint, or the frame rates do.
MotionTexture mix_models(const MotionTexture& a, const MotionTexture& b, MixReport& report, const JobContext& job = {});

}  // namespace motex
