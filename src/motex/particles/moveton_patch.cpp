// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/moveton_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/particles/coil_search.h"
#include "motex/particles/coils.h"

namespace motex {
namespace {

constexpr double kCell = 2 * kPatchReach / kPatchSide;  // core scales
constexpr double kMiddle = (kPatchSide - 1) / 2.0;

double turn_of(const Base& core) { return is_oriented(core.kind) ? core.angle : 0; }

/// out += weight · ψ / ‖ψ‖, on the cells that the base reaches.
void add_base(BaseKind kind, double u, double v, double scale, double angle, double weight, float* out) {
  const Base cell{kind, kMiddle + u / kCell, kMiddle + v / kCell, std::max(0.5, scale / kCell), angle, {}};
  const BaseReach reach = reach_of(cell);
  const int left = std::max(0, static_cast<int>(std::floor(cell.x)) - reach.x),
            top = std::max(0, static_cast<int>(std::floor(cell.y)) - reach.y);
  const int width = std::min(kPatchSide, static_cast<int>(std::floor(cell.x)) + reach.x + 2) - left,
            height = std::min(kPatchSide, static_cast<int>(std::floor(cell.y)) + reach.y + 2) - top;
  if (width <= 0 || height <= 0) return;
  std::array<float, kPatchSize> values;
  evaluate(cell, left, top, width, height, values.data());
  const auto factor = static_cast<float>(weight / (analytic_norm(kind) * scale));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      out[(top + y) * kPatchSide + left + x] += factor * values[static_cast<std::size_t>(y * width + x)];
}

}  // namespace

double analytic_norm(BaseKind kind) {
  constexpr double kPi = std::numbers::pi, kSquare = kGaborFrequency * kGaborFrequency;
  switch (kind) {
    case BaseKind::kLog:
      return std::sqrt(2 * kPi);
    case BaseKind::kGaborCos:
      return std::sqrt(2 * kPi * (0.5 * (1 + std::exp(-kSquare)) - 2 * std::exp(-0.75 * kSquare) + std::exp(-kSquare)));
    case BaseKind::kGaborSin:
      return std::sqrt(2 * kPi * 0.5 * (1 - std::exp(-kSquare)));
    case BaseKind::kStreak:
      return std::sqrt(kGaborElongation * kPi);
    case BaseKind::kGaussian:
      break;
  }
  return std::sqrt(kPi);
}

double luma_coefficient(const RelativeBase& base, int num_planes) {
  const auto& [red, green, blue] = base.coefficient;
  return num_planes < 3 ? red : luma_of(red, green, blue);
}

RelativeBase relative_to(const Base& base, const Base& core, int num_planes) {
  const double turn = turn_of(core), c = std::cos(turn), s = std::sin(turn);
  const double dx = (base.x - core.x) / core.scale, dy = (base.y - core.y) / core.scale;
  const double strength = luma_coefficient(core, num_planes);
  RelativeBase out{base.kind, dx * c + dy * s, dy * c - dx * s, std::log(base.scale / core.scale), 0, {}};
  if (is_oriented(base.kind)) out.angle = base.angle - turn;
  for (std::size_t k = 0; k < static_cast<std::size_t>(num_planes); ++k)
    out.coefficient[k] = strength != 0 ? static_cast<double>(base.coefficients[k]) / strength : 0;
  return out;
}

Base placed_at(const RelativeBase& relative, const Base& core, int num_planes) {
  const double turn = turn_of(core), c = std::cos(turn), s = std::sin(turn);
  const double strength = luma_coefficient(core, num_planes);
  Base out{relative.kind,
           core.x + core.scale * (relative.u * c - relative.v * s),
           core.y + core.scale * (relative.u * s + relative.v * c),
           core.scale * std::exp(relative.log_scale),
           is_oriented(relative.kind) ? relative.angle + turn : 0,
           {}};
  for (std::size_t k = 0; k < static_cast<std::size_t>(num_planes); ++k)
    out.coefficients[k] = static_cast<float>(relative.coefficient[k] * strength);
  return out;
}

void render_moveton(BaseKind core_kind, std::span<const RelativeBase> coils, int num_planes, float* out) {
  std::fill_n(out, kPatchSize, 0.0F);
  add_base(core_kind, 0, 0, 1, 0, 1, out);
  for (const RelativeBase& coil : coils)
    add_base(coil.kind, coil.u, coil.v, std::exp(coil.log_scale), coil.angle, luma_coefficient(coil, num_planes), out);
  double energy = 0;
  for (std::size_t i = 0; i < kPatchSize; ++i) energy += static_cast<double>(out[i]) * static_cast<double>(out[i]);
  const auto factor = static_cast<float>(energy > 0 ? 1 / std::sqrt(energy) : 0);
  for (std::size_t i = 0; i < kPatchSize; ++i) out[i] *= factor;
}

}  // namespace motex
