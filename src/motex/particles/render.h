// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "motex/image/planes.h"
#include "motex/particles/moveton_frame.h"

namespace motex {

/// I = background + Σ α_j b_j [TM02] eq. 3, fast and at any multiple m of the resolution.
///
/// The centre (x, y) becomes m (x + ½) − ½, the scale m s; grey levels stay, so that the picture is the same one with
/// finer pixels; at m = 1 it equals reconstruct() of base.h. Round bases are sums of products of a row and a column,
/// Gabors products of tables and one power a row. Cost: the pixels of the boxes outside which bases are below 1/100 of
/// their peak; nothing is allocated once the largest base has been seen.
class BaseRenderer {
 public:
  /// num_base_planes: coefficients that bases have, 1 or 3. Throws InvalidInput unless 1/64 ≤ m ≤ 64.
  explicit BaseRenderer(double magnification = 1, int num_base_planes = 3);

  /// planes: 1 or 3, of the magnified size; each gets its own coefficient (of 1 plane the first; three planes of bases
  /// with one coefficient that one). Bases of scale 0 or that are not finite are passed over.
  void add(std::span<const Base> bases, Planes& planes);
  double magnification() const { return magnification_; }

 private:
  void add_round(const Base& base, Planes& planes);
  void add_oriented(const Base& base, Planes& planes);
  double evaluate_oriented(const Base& base, int left, int top, int width, int height);

  float coefficient(const Base& base, std::size_t plane) const {
    return base.coefficients[num_base_planes_ == 1 ? 0 : plane];
  }

  double magnification_;
  int num_base_planes_;
  std::vector<float> bell_, hat_, wave_cos_, wave_sin_, patch_;
};

}  // namespace motex
