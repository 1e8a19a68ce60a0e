// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "motex/image/flat_colours.h"
#include "motex/people/sprite.h"

namespace motex {

/// Colours that the actor may have near a pixel at his rim.
struct FrontColours {
  LevelTriple near{}, around{};  ///< means over ± 4 and ± 8 pixels
  bool known = false;
};

/// α of I = α (k F) + (1 − α) B for the F among `fronts` that explains the pixel best, k the light on the rim, which is
/// 1 give or take kShading: with δ = α (k − 1) the least |I − B − α (F − B) − δ F|² / noise² + δ² / kShading² has
///   α = (I − B)ᵀ M (F − B) / ((F − B)ᵀ M (F − B) · 0.96),   M = 1 − F Fᵀ / (|F|² + noise² / kShading²)
/// (the rim has about 4 % more of the screen's light on it than what F was carried from), cut off at 0 and 1 and within
/// two deviations of them. inside: squares to the nearest one that is background; where the pixel lies off all lines,
/// far from B and not at the very rim it is another material and opaque. noise: deviation of a channel.
inline float unmixed_alpha(const LevelTriple& pixel, const LevelTriple& back, const FrontColours& fronts, float noise,
                           int inside) {
  constexpr float kSpilled = 0.96F, kDeadBand = 2, kOffLine = 5, kBend = 0.1F, kContrast = 0.3F, kShading = 0.15F,
                  kLeastShare = 0.05F, kModel = 0.0004F;
  const float dr = pixel[0] - back[0], dg = pixel[1] - back[1], db = pixel[2] - back[2];
  const float difference = dr * dr + dg * dg + db * db, variance = noise * noise;
  float best_along = 0, best_length = 0, best_whole = 0, best_rest = -1;
  for (const LevelTriple* front : {&fronts.near, &fronts.around}) {
    const auto [r, g, b] = *front;
    const float fr = r - back[0], fg = g - back[1], fb = b - back[2];
    const float whole = fr * fr + fg * fg + fb * fb;
    if (whole < 9 * variance) continue;
    const float straight = dr * fr + dg * fg + db * fb;
    const float share = kShading * std::clamp(straight / whole, kLeastShare, 1.0F);
    const float light = 1 / (r * r + g * g + b * b + (variance + kModel * whole) / (share * share));
    const float of_pixel = dr * r + dg * g + db * b, of_front = fr * r + fg * g + fb * b;
    const float length = std::max(variance, whole - of_front * of_front * light);
    const float along = straight - of_pixel * of_front * light;
    const float rest = std::max(0.0F, difference - of_pixel * of_pixel * light - along * along / length);
    if (best_rest >= 0 && rest >= best_rest) continue;
    best_along = along, best_length = length, best_whole = whole, best_rest = rest;
    if (rest <= variance) break;  // as good as noise allows
  }
  if (best_rest < 0) return inside > 0 ? 1.0F : 0.0F;
  const float limit = kOffLine * kOffLine * variance + kBend * kBend * best_whole;
  if (inside > 1 && best_rest > limit && difference > kContrast * kContrast * best_whole) return 1;
  const float alpha = best_along / (kSpilled * best_length);
  const float band = std::min(0.25F, kDeadBand * noise / std::sqrt(best_length));
  if (alpha < band) return 0;
  return alpha > 1 - band ? 1 : alpha;
}

inline float luma_of(const LevelTriple& colour) { return 0.299F * colour[0] + 0.587F * colour[1] + 0.114F * colour[2]; }

/// Most that the screen's light takes of a colour of the actor; what is more green is partly transparent.
constexpr float kMostSpill = 0.2F;

/// Share s of the screen's light in a colour F = (1 − s) F₀ + s B of the actor, F₀ his colour further inside: the
/// projection of F − F₀ on B − F₀ where F lies near that line; else what `excess` of B's leading channel over the other
/// two F has beyond F₀'s and beyond 0, so that green clothes stay green, at most
/// kMostSpill. 0 … 0.95.
float spill_share(const LevelTriple& colour, const LevelTriple& inner, const LevelTriple& screen, int screen_channel);

}  // namespace motex
