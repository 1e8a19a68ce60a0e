// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "motex/particles/base.h"

namespace motex {

/// Products with the Gram matrix of bases through pixels: out = Bᵀ(B in). Costs the pixels of all patches however many
/// of them overlap, where inner products cost the pairs: hundreds a base in a burst of fireworks.
class PaintedProducts {
 public:
  /// Copies of the patches; none = nothing to multiply by.
  explicit PaintedProducts(const std::vector<BasePatch>& patches);

  /// out_j = ⟨b_j, Σ_k in_k b_k⟩. canvas: a buffer, kept from call to call.
  void multiply(const std::vector<double>& in, std::vector<double>& out, std::vector<float>& canvas) const;

 private:
  struct Place {
    std::size_t first_value = 0;  // in values_
    std::size_t first_pixel = 0;  // on the canvas
    int num_rows = 0;
    int num_lanes = 0;  // a row
  };

  std::vector<Place> places_;
  std::vector<float> values_;  // rows of each patch, filled up with zeros to whole lanes
  std::size_t stride_ = 0;     // of the canvas, which bounds all patches
  std::size_t num_pixels_ = 0;
};

}  // namespace motex
