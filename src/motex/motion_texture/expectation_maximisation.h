// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "motex/motion_texture/emissions.h"
#include "motex/motion_texture/move_path.h"
#include "motex/motion_texture/texton_fitter.h"

namespace motex {

/// Hard EM [MT02 4]: E = the most likely segmentation, M = textons and transitions at their maximum a posteriori.
/// Each step maximises one objective over its own unknowns, so the objective never falls:
///
///   J = Σ_t F_{l(t)}(t) + Σ_k log M_{l(k−1) l(k)} + Σ_i log p(A_i, B_iB_iᵀ) + log p(M)
///       + w Σ_k log [N(z_k; m_{l(k)}, I) / N(z_k; 0, R)] + w Σ_i log p(m_i)   with paths (MovePaths)
///
/// Only textons whose segments changed are fitted and evaluated again.
class ExpectationMaximisation {
 public:
  /// paths == nullptr: textons have none.
  ExpectationMaximisation(const Corpus& corpus, const TextonFitter& fitter, const LearnOptions& options,
                          Index min_frames, Index max_frames, Segmentation start, const MovePaths* paths = nullptr);

  /// One M-step and one E-step. Returns J after it. converged() when the segmentation did not change.
  double iterate(const JobContext& job);
  bool converged() const { return converged_; }
  /// Fits the textons to the last segmentation, where EM was stopped before it settled.
  void finish(const JobContext& job) {
    if (!converged_) maximise(job);
  }

  const Segmentation& segments() const { return segments_; }
  const std::vector<TextonFit>& textons() const { return fits_; }
  double outside_deviation() const { return deviation_; }

 private:
  void maximise(const JobContext& job);
  void fit_paths(const std::vector<std::vector<LabelledSegment>>& own, const JobContext& job);
  double expect(const JobContext& job);
  TextonFit refit(int texton, const std::vector<LabelledSegment>& own) const;
  double contribution(const TextonFit& fit) const;
  double choose_deviation() const;
  std::vector<std::vector<LabelledSegment>> by_texton() const;

  const Corpus& corpus_;
  const TextonFitter& fitter_;
  LearnOptions options_;
  Index min_frames_, max_frames_;
  Segmentation segments_;
  const MovePaths* paths_;
  std::vector<Vector> path_of_;  ///< of each texton
  FrameMatrixF starts_;          ///< frames × textons: what paths say of a segment that starts there
  std::vector<std::vector<LabelledSegment>> fitted_to_;  ///< segments that each texton was last fitted to
  std::vector<TextonFit> fits_;
  double deviation_ = 1;
  std::unique_ptr<EmissionBank> bank_;
  FrameMatrixF emissions_;
  TransitionMatrix transitions_;
  bool converged_ = false;
};

}  // namespace motex
