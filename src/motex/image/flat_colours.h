// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "motex/image/planes.h"

namespace motex {

using LevelTriple = std::array<float, 3>;  ///< R, G, B in grey levels 0 … 255

inline LevelTriple levels(const Rgba& p) {
  return {static_cast<float>(p.r), static_cast<float>(p.g), static_cast<float>(p.b)};
}

/// Up to `count` colours that stand for many: k-means, started from as many quantiles of the luma, so the same for the
/// same input; darkest first. weights: empty = all alike. Throws InvalidInput when count < 1 or nothing is given.
std::vector<LevelTriple> palette(std::span<const LevelTriple> colours, std::span<const double> weights, int count);

/// Index of the palette's nearest colour.
int nearest_colour(const std::vector<LevelTriple>& palette, const LevelTriple& colour);

struct FlatColoursOptions {
  int num_colours = 6;
  double smoothing = 0;  ///< pixels, blur before colours are chosen; 0 = 1/80 of the longer side
};

/// A picture in few flat colours with smooth, anti-aliased borders, enlarged by `magnification`: pixels are blurred,
/// put to the nearest colour of their palette, and each region's border is drawn where its blurred share passes that of
/// the others. planes: 1 or 3.
Image flat_colours(const Planes& planes, double magnification = 1, const FlatColoursOptions& options = {});

}  // namespace motex
