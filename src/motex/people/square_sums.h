// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "motex/image/image.h"

namespace motex {

/// R, G and B added up over squares of 2 × 2 pixels, 0 … 1020; a last odd column or row counts twice.
struct SquareSums {
  int width = 0, height = 0;  ///< in squares
  std::array<std::vector<std::uint16_t>, 3> channels;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// Memory of `sums` is used again.
void sum_squares(const Image& image, SquareSums& sums);

/// How much darker and lighter than its plate a background may be, as shares: shadows, a lamp that flickers.
struct LightRange {
  float darker = 0.12F, lighter = 0.06F;
};

/// Smallest |(1 + t) P − I|² for −darker ≤ t ≤ lighter, with d = I − P.
inline float squared_difference(float dr, float dg, float db, float pr, float pg, float pb, const LightRange& light) {
  const float along = dr * pr + dg * pg + db * pb, length = pr * pr + pg * pg + pb * pb + 1;
  const float t = std::min(std::max(along / length, -light.darker), light.lighter);
  return std::max(0.0F, dr * dr + dg * dg + db * db - 2 * t * along + t * t * length);
}

}  // namespace motex
