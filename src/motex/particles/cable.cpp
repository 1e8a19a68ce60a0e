// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/cable.h"

#include <cmath>
#include <vector>

namespace motex {
namespace {

/// Highest |ψ| of a base of unit norm over the pixels.
double peak_of_unit_norm(const Base& base) {
  const BaseReach reach = reach_of(base);
  const int left = static_cast<int>(std::lround(base.x)) - reach.x,
            top = static_cast<int>(std::lround(base.y)) - reach.y;
  const int width = 2 * reach.x + 1, height = 2 * reach.y + 1;
  std::vector<float> values(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  evaluate(base, left, top, width, height, values.data());
  double energy = 0;
  for (const float value : values) energy += static_cast<double>(value) * static_cast<double>(value);
  double crest = 1;  // Gaussian
  if (base.kind == BaseKind::kLog) crest = 2;
  if (base.kind == BaseKind::kGaborCos) crest = 1 - std::exp(-kGaborFrequency * kGaborFrequency / 2);
  // the crest of sin(ωq) e^{−q²/2} is at q = 0.813
  if (base.kind == BaseKind::kGaborSin) crest = 0.59501;
  return energy > 0 ? crest / std::sqrt(energy) : 0;
}

}  // namespace

double peak_amplitude(const Base& base, int plane) {
  return static_cast<double>(base.coefficients[static_cast<std::size_t>(plane)]) * peak_of_unit_norm(base);
}

double coefficient_of_peak(const Base& base, double amplitude) {
  const double peak = peak_of_unit_norm(base);
  return peak > 0 ? amplitude / peak : 0;
}

}  // namespace motex
