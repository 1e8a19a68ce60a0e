// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "motex/motion_texture/corpus.h"

namespace motex {

/// A texton fitted to segments, and what it contributes to the learner's objective.
struct TextonFit {
  Subspace subspace;  ///< empty with a shared basis: it is TextonFitter::shared()
  Lds dynamics;
  LdsStatistics statistics;
  double outside_squares = 0;  ///< Σ |y − μ − C x|² over the counted frames (own basis)
  double log_prior = 0;
};

/// Weight of the prior in frames: as asked for, or what each kind of basis needs.
double prior_frames_of(const LearnOptions& options);

/// M-step for one texton: subspace, then maximum a posteriori dynamics in it [MT02 appendix B].
/// The prior is the whole corpus, seen in the texton's subspace.
class TextonFitter {
 public:
  TextonFitter(const Corpus& corpus, const LearnOptions& options);

  bool is_shared() const { return options_.basis == Basis::kShared; }
  const Subspace& shared() const { return shared_; }
  const FrameMatrix& shared_states() const { return states_; }
  const LdsStatistics& shared_statistics() const { return statistics_; }
  double prior_frames() const { return prior_frames_; }

  /// Subspace and dynamics from the segments' frames. No segment: not allowed with an own basis.
  TextonFit fit(std::span<const LabelledSegment> segments, double prior_frames) const;
  /// Dynamics alone; the subspace stays.
  TextonFit fit_within(const Subspace& subspace, std::span<const LabelledSegment> segments, double prior_frames) const;
  /// Frames that count for the likelihood: those with two frames before them in the run.
  Index num_counted(const LabelledSegment& segment) const;

 private:
  LdsPrior own_prior(const Subspace& subspace, double prior_frames) const;
  Lds fit_dynamics(const LdsStatistics& statistics, const LdsPrior& prior) const;

  const Corpus& corpus_;
  LearnOptions options_;
  double prior_frames_;
  Subspace shared_;
  FrameMatrix states_;        ///< frames × d in the shared subspace
  LdsStatistics statistics_;  ///< of all frames there
  Matrix common_transition_;  ///< with common_dynamics
  CentredMoments lagged_;     ///< own basis: of [y_t; y_{t−1}; y_{t−2}], 3D × 3D
};

}  // namespace motex
