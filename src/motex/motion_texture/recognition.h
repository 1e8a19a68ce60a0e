// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/markov/segmentation.h"
#include "motex/motion_texture/corpus.h"

namespace motex {

/// Frames that a learned model is to recognise: how well each texton explains each of them.
class Recognition {
 public:
  /// The model and corpus must outlive it. Dropped textons explain nothing (−∞).
  Recognition(const MotionTexture& model, const Corpus& corpus, const JobContext& job = {});

  /// F: frames × textons, log densities given the frames before.
  const FrameMatrixF& emissions() const { return emissions_; }
  /// The most likely segmentation of a run by dynamics and transitions. Throws InvalidInput where no lengths of
  /// segments add up to it.
  SegmentationReport by_dynamics(const Run& run) const;
  /// The same with the paths of moves, if the model has them: what the textons are called.
  std::vector<Segment> by_moves(const Run& run) const;
  /// Log density of the run's frames and of these textons, paths left out.
  double log_likelihood(const Run& run, const std::vector<Segment>& segments) const;
  const SegmentOptions& rules() const { return rules_; }

 private:
  SegmentationInput input(const Run& run, bool with_paths) const;

  SegmentOptions rules_;
  TransitionMatrix transitions_;
  FrameMatrixF emissions_;
  FrameMatrixF starts_;  ///< frames × textons, or empty
};

/// T_min of the model, frames.
Index shortest_segment(const MotionTexture& model);

/// F of every frame under the one global system of the model.
Vector global_log_densities(const MotionTexture& model, const Corpus& corpus, const JobContext& job = {});

}  // namespace motex
