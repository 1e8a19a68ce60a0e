// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "motex/image/flat_colours.h"
#include "motex/people/four_levels.h"

namespace motex {

/// Colours that the actor may have near a pixel at his rim.
struct FrontColours {
  LevelTriple near{}, around{};  ///< means over ± 4 and ± 8 pixels
  bool known = false;
};

/// α of I = α (k F) + (1 − α) B for the F among `fronts` that explains the pixel best, k the light on the rim, 1 give
/// or take s = 0.15. With δ = α (k − 1) the least |I − B − α (F − B) − δ F|² / v + δ² / (s α₀)² has
///   α = (I − B)ᵀ M (F − B) / ((F − B)ᵀ M (F − B) · 0.96),   M = 1 − F Fᵀ / (|F|² + v / (s α₀)²)
/// with v = noise² + 0.02² |F − B|² and α₀ the same for k = 1, at least 0.05; k = 1 where that fits within noise. (The
/// rim has about 4 % more of the screen's light on it than what F was carried from.) Cut off at 0 and 1 and within two
/// deviations of them. inside: squares to the nearest one that is background; where the pixel lies off all lines, far
/// from B and not at the very rim it is another material and opaque. noise: deviation of a channel.
inline Four unmixed_alpha(const FourTriple& pixel, const FourTriple& back, const FrontColours& fronts, float noise,
                          int inside) {
  constexpr float kSpilled = 0.96F, kDeadBand = 2, kOffLine = 5, kBend = 0.1F, kContrast = 0.3F, kShading = 0.15F,
                  kLeastShare = 0.05F, kModel = 0.0004F, kLit = 12;
  const Four dr = pixel[0] - back[0], dg = pixel[1] - back[1], db = pixel[2] - back[2];
  const Four difference = dr * dr + dg * dg + db * db;
  const float variance = noise * noise;
  Four best_along{}, best_length = four_of(1), best_whole{}, best_rest = four_of(-1);
  for (const LevelTriple* front : {&fronts.near, &fronts.around}) {
    const auto [r, g, b] = *front;
    const Four fr = r - back[0], fg = g - back[1], fb = b - back[2];
    const Four whole = fr * fr + fg * fg + fb * fb;
    const Four straight = dr * fr + dg * fg + db * fb;
    const Four share = kShading * clamped(straight / most_of(whole, four_of(1)), kLeastShare, 1);
    const Four light = 1 / (r * r + g * g + b * b + (variance + kModel * whole) / (share * share));
    const Four of_pixel = dr * r + dg * g + db * b, of_front = fr * r + fg * g + fb * b;
    const Four length = most_of(four_of(variance), whole - of_front * of_front * light);
    const Four along = straight - of_pixel * of_front * light;
    const auto is_lit = difference * whole - straight * straight <= kLit * variance * whole;  // k = 1 fits
    const Four rest = most_of(four_of(0), difference - of_pixel * of_pixel * light - along * along / length);
    // What fits as well as noise allows is not compared any more.
    const auto is_better = (whole >= 9 * variance) & ((best_rest < 0) | ((rest < best_rest) & (best_rest > variance)));
    best_along = is_better ? (is_lit ? straight : along) : best_along;
    best_length = is_better ? (is_lit ? whole : length) : best_length;
    best_whole = is_better ? whole : best_whole, best_rest = is_better ? rest : best_rest;
  }
  const Four alpha = best_along / (kSpilled * best_length);
  const Four band = least_of(four_of(0.25F), kDeadBand * noise / root_of(best_length));
  Four result = alpha < band ? four_of(0) : alpha > 1 - band ? four_of(1) : alpha;
  const Four limit = kOffLine * kOffLine * variance + kBend * kBend * best_whole;
  if (inside > 1)
    result = ((best_rest > limit) & (difference > kContrast * kContrast * best_whole)) ? four_of(1) : result;
  return best_rest < 0 ? four_of(inside > 0 ? 1.0F : 0.0F) : result;
}

/// Most that the screen's light takes of a colour of the actor; what is more green is partly transparent.
constexpr float kMostSpill = 0.2F;

/// Share s of the screen's light in a colour F = (1 − s) F₀ + s B of the actor, F₀ his colour further inside: the
/// projection of F − F₀ on B − F₀ where F lies near that line; else what `excess` of B's leading channel over the other
/// two F has beyond F₀'s and beyond 0, so that green clothes stay green, at most kMostSpill. 0 … 0.95.
/// screen_channel: 1 = green, 2 = blue, −1 = neither.
inline Four spill_share(const FourTriple& colour, const LevelTriple& inner, const FourTriple& screen,
                        int screen_channel) {
  constexpr float kAll = 0.95F, kSameMaterial = 14;  // grey levels off the line
  Four along{}, length{}, square{};
  for (std::size_t c = 0; c < 3; ++c) {
    const Four d = colour[c] - inner[c], b = screen[c] - inner[c];
    along += d * b, length += b * b, square += d * d;
  }
  const Four projected = along / most_of(length, four_of(1));
  Four share{};
  if (screen_channel >= 0) {
    const auto channel = static_cast<std::size_t>(screen_channel);
    const std::size_t other = (channel + 1) % 3, third = (channel + 2) % 3;
    const float allowed = std::max(0.0F, inner[channel] - std::max(inner[other], inner[third]));
    const Four much = screen[channel] - most_of(screen[other], screen[third]);
    const Four excess = colour[channel] - most_of(colour[other], colour[third]);
    const Four beyond = clamped((excess - allowed) / most_of(much - allowed, four_of(1)), 0, kMostSpill);
    share = much <= allowed + 10 ? four_of(0) : beyond;
  }
  share = square - along * projected < kSameMaterial * kSameMaterial ? clamped(projected, 0, kAll) : share;
  return length < 400 ? four_of(0) : share;
}

}  // namespace motex
