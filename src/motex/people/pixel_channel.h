// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace motex {

/// Of a pixel as it lies in memory: red at 0, green 8, blue 16, alpha 24. By way of a signed integer, which vector code
/// converts fast.
inline float channel(std::uint32_t pixel, int shift) {
  return static_cast<float>(static_cast<std::int32_t>((pixel >> shift) & 0xFFU));
}

}  // namespace motex
