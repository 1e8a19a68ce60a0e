// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/lds/lds.h"

namespace motex {

/// The problem of Bridge by its normal equations: block-banded, Toeplitz, positive definite and well conditioned
/// however unstable the system is, where the Gramian of Bridge loses its digits. The Cholesky factor does not depend on
/// the length: block k is computed once, when a path first needs it. Cost O(d³) a new block, then 9 l d²
/// multiplications a path.
class BandedBridge {
 public:
  explicit BandedBridge(const Lds& lds);

  /// states: l × d, l ≥ 4; rows 0, 1, l−2, l−1 are given and kept, the others are overwritten.
  /// noise: (l − 2) × d, the ε of rows 2 … l−1.
  void solve(Eigen::Ref<FrameMatrix> states, const Eigen::Ref<const FrameMatrix>& noise);

 private:
  struct Block {
    Matrix lower_inverse;  ///< L_kk⁻¹
    Matrix below1;         ///< L_{k,k−1}
    Matrix below2;         ///< L_{k,k−2}
  };
  void append_block();

  Index d_;
  Matrix g0_, g1_, g2_;  ///< B⁻¹, −B⁻¹A₁, −B⁻¹A₂
  Vector offset_;        ///< B⁻¹D
  Matrix h0_, h1_, h2_;  ///< blocks of the normal matrix on and below the diagonal
  std::vector<Block> blocks_;
  Matrix residuals_, swept_;  ///< work space: d × (l − 2) and d × (l − 4)
};

}  // namespace motex
