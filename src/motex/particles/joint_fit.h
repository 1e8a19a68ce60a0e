// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "motex/particles/base.h"
#include "motex/particles/painted_products.h"

namespace motex {

/// Coefficients of all bases of a frame together: the α that minimise ‖target − Σ α_j b_j‖² + ridge · ‖α − start‖².
/// Set up once a frame, solved once a plane. Inner products of those that overlap are kept; where these are many the
/// bases are painted and measured instead.
class JointFit {
 public:
  JointFit(const std::vector<Base>& bases, int width, int height, double ridge);

  /// Conjugate gradients on the Gram matrix. Returns as many coefficients as there are bases.
  std::vector<float> solve(const Plane& target, const std::vector<float>& start) const;
  const std::vector<BasePatch>& patches() const { return patches_; }

 private:
  struct Pair {
    int a, b;
  };
  std::vector<Pair> overlapping(std::size_t most) const;
  void keep_products(const std::vector<Pair>& pairs);
  void multiply(const std::vector<double>& in, std::vector<double>& out, std::vector<float>& canvas) const;

  double ridge_;
  std::vector<BasePatch> patches_;
  struct Overlap {
    int other;
    double product;
  };
  std::vector<std::size_t> row_begin_;  // of overlaps_, upper triangle without the diagonal
  std::vector<Overlap> overlaps_;
  std::vector<double> energies_;
  std::optional<PaintedProducts> painted_;  // in their place
};

}  // namespace motex
