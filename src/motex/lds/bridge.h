// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/lds/lds.h"

namespace motex {

/// Constrained synthesis [MT02 5.4, eq. 8]: given the two first and the two last states, the path between them that
/// minimises Σ_t |B⁻¹(x_t − A₁ x_{t−1} − A₂ x_{t−2} − D) − ε_t|². With ε ~ N(0, I) it is an exact sample of the system
/// given both ends.
///
/// The normal equations are block-banded Toeplitz, so their Cholesky factor does not depend on the length: block k is
/// computed once, when a path first needs it, and from the block on where the factor no longer changes (relative 1e-9) one
/// block serves all. Then a path of l frames costs 4 l d² multiplications: a free run, and a correction swept back from the end.
class Bridge {
 public:
  explicit Bridge(const Lds& lds);

  /// states: l × d, l ≥ 4; rows 0, 1, l−2, l−1 are given and kept, the others are overwritten.
  /// noise: (l − 2) × d, the ε of rows 2 … l−1.
  void solve(Eigen::Ref<FrameMatrix> states, const Eigen::Ref<const FrameMatrix>& noise);

  /// Blocks held; stops growing when the factor has converged.
  Index num_blocks() const { return static_cast<Index>(blocks_.size()); }

 private:
  struct Block {
    Matrix lower_inverse;  ///< L_kk⁻¹
    Matrix below1;         ///< L_{k,k−1}
    Matrix below2;         ///< L_{k,k−2}
    Matrix back1, back2;   ///< L_kk⁻ᵀ L_{k+1,k}ᵀ and L_kk⁻ᵀ L_{k+2,k}ᵀ
  };
  const Block& block(Index k);
  void append_block();

  Index d_;
  Matrix transition_, noise_chol_;
  Vector offset_;
  Matrix g0_, g1_, g2_;  ///< B⁻¹, −B⁻¹A₁, −B⁻¹A₂
  Matrix h0_, h1_, h2_;  ///< blocks of the normal matrix on and below the diagonal
  std::vector<Block> blocks_;
  bool converged_ = false;
  Vector r0_, r1_, y0_, y1_, x_;  ///< work space
};

}  // namespace motex
