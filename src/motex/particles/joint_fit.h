// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "motex/particles/base.h"

namespace motex {

/// Coefficients of all bases of a frame together, with the inner products of those that overlap kept: the α that
/// minimise ‖target − Σ α_j b_j‖² + ridge · ‖α − start‖². Set up once a frame, solved once a plane.
class JointFit {
 public:
  JointFit(const std::vector<Base>& bases, int width, int height, double ridge);

  /// Conjugate gradients on the sparse Gram matrix. Returns as many coefficients as there are bases.
  std::vector<float> solve(const Plane& target, const std::vector<float>& start) const;
  const std::vector<BasePatch>& patches() const { return patches_; }

 private:
  void multiply(const std::vector<double>& in, std::vector<double>& out) const;

  double ridge_;
  std::vector<BasePatch> patches_;
  struct Overlap {
    int other;
    double product;
  };
  std::vector<std::size_t> row_begin_;  // of overlaps_, upper triangle without the diagonal
  std::vector<Overlap> overlaps_;
  std::vector<double> energies_;
};

}  // namespace motex
