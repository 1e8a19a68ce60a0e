// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/motion_texture/corpus.h"

namespace motex {

/// Log density of every frame given the two before it, for all textons at once:
///
///   F_i(t) = log N(x_t; A₁x_{t−1} + A₂x_{t−2} + D, BBᵀ) + log N(y_t − μ_i − C_i x_t; 0, s² I on D − d dimensions),
///   x = C_iᵀ(y − μ_i)
///
/// Each texton is a few rows that the frames [1, y_t, y_{t−1}, y_{t−2}] are multiplied with: one matrix product for all
/// textons and a block of frames, then sums of squares. Cost 2 · T · N · d · (3m + 1) with m = d (shared basis) or D
/// (own).
class EmissionBank {
 public:
  /// With shared != nullptr the frames are projected once and all textons live there.
  EmissionBank(const FrameMatrix& features, const std::vector<Run>& runs, const Subspace* shared,
               double outside_deviation);

  /// dynamics in the coordinates of subspace; textons may have different state sizes.
  void set_texton(int texton, const Subspace& subspace, const Lds& dynamics);
  int num_textons() const { return static_cast<int>(rows_.size()); }

  /// F for the named textons into columns of `out` (frames × textons); others are kept. The first two frames of each
  /// run, which nothing precedes, get 0.
  void evaluate(const std::vector<int>& textons, FrameMatrixF& out, const JobContext& job) const;

 private:
  struct Rows {
    FrameMatrixF residual;  ///< d × (3m + 1): B⁻¹ [−D', C, −A₁C, −A₂C]
    FrameMatrixF outside;  ///< (d + 1) × (m + 1), or empty: C with its constant, then |y − μ|² − |y|² as a linear form
    double constant = 0;  ///< normalisation of both densities
  };
  void evaluate_block(const std::vector<int>& textons, Index row, Index count, FrameMatrixF& out) const;

  const std::vector<Run>& runs_;
  bool is_shared_;
  double deviation_;
  Vector centre_;                ///< own basis: corpus mean, taken off for precision
  FrameMatrixF inputs_;          ///< frames × m
  std::vector<double> outside_;  ///< shared: log density outside; own: |y|²
  Index num_features_;
  std::vector<Rows> rows_;
};

}  // namespace motex
