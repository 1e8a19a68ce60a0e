// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <map>
#include <optional>
#include <vector>

#include "motex/lds/banded_bridge.h"
#include "motex/lds/lds.h"

namespace motex {

/// Constrained synthesis [MT02 5.4, eq. 8]: given the two first and the two last states, the path between them that
/// minimises Σ_t |B⁻¹(x_t − A₁ x_{t−1} − A₂ x_{t−2} − D) − ε_t|². With ε ~ N(0, I) it is an exact sample of the system
/// given both ends.
///
/// In whitened coordinates z = B⁻¹x with s_t = [z_t; z_{t−1}], Φ the companion matrix and n = l − 2 steps, the
/// minimiser is the free run of ε plus the response to the smallest extra noise that leads to the end:
///
///   P_n λ_l = s_l − s_l(free),   P_n = Σ_{k<n} Φᵏ Q Φᵏᵀ,   λ_{t−1} = Φᵀ λ_t,   ε'_t = ε_t + upper half of λ_t
///
/// P_n is made by doubling and its Cholesky factor kept for each length; then a path costs 6.5 l d² multiplications.
/// Where the system grows so much that P_n has no digits left, BandedBridge solves the same problem.
class Bridge {
 public:
  explicit Bridge(const Lds& lds);

  /// states: l × d, l ≥ 4; rows 0, 1, l−2, l−1 are given and kept, the others are overwritten.
  /// noise: (l − 2) × d, the ε of rows 2 … l−1.
  void solve(Eigen::Ref<FrameMatrix> states, const Eigen::Ref<const FrameMatrix>& noise);

 private:
  struct Steps {
    Matrix power;    ///< Φⁿ
    Matrix gramian;  ///< P_n
  };
  Steps join(const Steps& a, const Steps& b) const;
  const Eigen::LLT<Matrix>* factor(Index num_steps);  ///< nullptr: not to be trusted
  void run(Index num_steps, const Eigen::Ref<const FrameMatrix>& noise, bool add_multipliers);

  static constexpr std::size_t kMostFactors = 64;
  Lds lds_;
  std::optional<BandedBridge> banded_;
  Index d_;
  Matrix noise_chol_, a1_, a2_;  ///< B, B⁻¹A₁B, B⁻¹A₂B
  Vector offset_;                ///< B⁻¹D
  std::vector<Steps> doubled_;   ///< n = 1, 2, 4, …
  std::map<Index, Eigen::LLT<Matrix>> factors_;
  Matrix z_, multipliers_;  ///< work space: d × l and 2d × l, a column a frame
};

}  // namespace motex
