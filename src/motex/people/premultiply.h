// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace motex {

/// value · alpha / 255, rounded.
inline std::uint8_t premultiplied(int value, int alpha) {
  return static_cast<std::uint8_t>((value * alpha + 127) / 255);
}

}  // namespace motex
