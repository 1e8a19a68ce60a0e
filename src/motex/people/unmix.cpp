// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/unmix.h"

#include <algorithm>
#include <cstddef>

namespace motex {
namespace {

constexpr float kAll = 0.95F;
constexpr float kSameMaterial = 14;  // grey levels off the line

float excess(const LevelTriple& colour, std::size_t channel) {
  return colour[channel] - std::max(colour[(channel + 1) % 3], colour[(channel + 2) % 3]);
}

}  // namespace

float spill_share(const LevelTriple& colour, const LevelTriple& inner, const LevelTriple& screen, int screen_channel) {
  LevelTriple d{}, b{};
  float along = 0, length = 0, square = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    d[c] = colour[c] - inner[c], b[c] = screen[c] - inner[c];
    along += d[c] * b[c], length += b[c] * b[c], square += d[c] * d[c];
  }
  if (length < 400) return 0;
  const float projected = along / length;
  if (square - along * projected < kSameMaterial * kSameMaterial) return std::clamp(projected, 0.0F, kAll);
  if (screen_channel < 0) return 0;
  const auto channel = static_cast<std::size_t>(screen_channel);
  const float allowed = std::max(0.0F, excess(inner, channel)), much = excess(screen, channel);
  if (much <= allowed + 10) return 0;
  return std::clamp((excess(colour, channel) - allowed) / (much - allowed), 0.0F, kMostSpill);
}

}  // namespace motex
