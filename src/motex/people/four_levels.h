// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

namespace motex {

/// One number for each pixel of a square of 2 × 2: upper left, upper right, lower left, lower right.
using Four = float __attribute__((vector_size(16)));
using FourTriple = std::array<Four, 3>;  ///< R, G, B in grey levels

inline Four four_of(float value) { return Four{value, value, value, value}; }
inline Four least_of(Four a, Four b) { return a < b ? a : b; }
inline Four most_of(Four a, Four b) { return a > b ? a : b; }
inline Four clamped(Four value, float low, float high) { return least_of(most_of(value, four_of(low)), four_of(high)); }
inline Four root_of(Four value) {
  return Four{std::sqrt(value[0]), std::sqrt(value[1]), std::sqrt(value[2]), std::sqrt(value[3])};
}

}  // namespace motex
