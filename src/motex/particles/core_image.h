// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "motex/image/planes.h"
#include "motex/particles/cable_prior.h"

namespace motex {

/// What the cores leave of one frame. Rows are followed by zeros up to a multiple of eight and eight more, so that
/// boxes may be read in blocks of eight columns.
class ResidualFrame {
 public:
  explicit ResidualFrame(const Plane& image);

  int width() const { return width_; }
  int height() const { return height_; }
  const float* row(int y) const { return values_.data() + static_cast<std::size_t>(y) * stride_; }
  float* row(int y) { return values_.data() + static_cast<std::size_t>(y) * stride_; }
  double squared_error() const;

 private:
  int width_, height_;
  std::size_t stride_;
  std::vector<float> values_;
};

/// image += sign · core.
void paint_core(ResidualFrame& image, BaseKind kind, const CoreState& state, float sign);

/// Σ image² − Σ (image − core)², in squared grey levels: what the core explains.
double explained_by(const ResidualFrame& image, BaseKind kind, const CoreState& state);

/// The image near a state: JᵀJ and Jᵀ(image − core), J the derivatives of the core.
struct CoreLinearisation {
  std::array<std::array<double, kNumCoreCoordinates>, kNumCoreCoordinates> curvature{};
  CoreState slope{};
};
/// Round Gaussians: separable tables, three products a pixel (0.3 µs for a scale of 1.5); other kinds: by differences.
CoreLinearisation linearise_core(const ResidualFrame& image, BaseKind kind, const CoreState& state);

/// ⟨image, ψ⟩ and ⟨ψ, ψ⟩ with ψ the core of peak 1.
struct CoreProducts {
  double image = 0, own = 0;
};
CoreProducts core_products(const ResidualFrame& image, BaseKind kind, const CoreState& state);

}  // namespace motex
