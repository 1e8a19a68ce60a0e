// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "motex/particles/base.h"

namespace motex {

/// A moveton without its place, size, direction and brightness: core and coils rendered on a grid of kPatchSide²
/// points, kPatchReach core scales to each side of the core, turned with it where it is oriented, unit norm, the core
/// bright. What movetons are compared by: the squared distance of two patches is 2 − 2 · correlation.
constexpr int kPatchSide = 14;
constexpr double kPatchReach = 4;
constexpr std::size_t kPatchSize = static_cast<std::size_t>(kPatchSide) * kPatchSide;

/// A coil base relative to its core: as the fields of TemplateCoil.
struct RelativeBase {
  BaseKind kind = BaseKind::kGaussian;
  double u = 0, v = 0;                  ///< along and across the core's axis, core scales
  double log_scale = 0;                 ///< ln(scale / core scale)
  double angle = 0;                     ///< minus the core's where that is oriented
  std::array<double, 3> coefficient{};  ///< of each plane, divided by the core's luma coefficient
};

/// The luma coefficient, divided by the core's.
double luma_coefficient(const RelativeBase& base, int num_planes);

RelativeBase relative_to(const Base& base, const Base& core, int num_planes);
/// The inverse; the core has its coefficients.
Base placed_at(const RelativeBase& relative, const Base& core, int num_planes);

/// ‖ψ‖ over the plane for scale 1.
double analytic_norm(BaseKind kind);

/// Writes kPatchSize values. luma weights colours. All zero when the core is.
void render_moveton(BaseKind core_kind, std::span<const RelativeBase> coils, int num_planes, float* out);

}  // namespace motex
