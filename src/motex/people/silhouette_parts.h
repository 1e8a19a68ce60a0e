// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/people/region_runs.h"
#include "motex/people/silhouette.h"
#include "motex/people/sprite.h"

namespace motex {

/// A connected part of a silhouette (8 neighbours).
struct SilhouettePart {
  BoundingBox box;  ///< pixels of the sprite
  std::int64_t area = 0;
};

/// A silhouette taken apart. Kept between frames it allocates nothing.
struct SilhouetteParts {
  std::vector<RegionRun> runs;  ///< pixels of the sprite with alpha ≥ ½, from the top, from the left
  std::vector<SilhouettePart> parts;
  std::int64_t area = 0;          ///< of all parts
  std::int64_t largest_area = 0;  ///< of the largest part

  /// Smaller than 1/400 of the largest or than 4 pixels: noise of the matte, not a hand.
  bool is_speck(int part) const;

  static constexpr int kBlock = 32;  ///< rows of `alphas` are filled up with 0 to a whole number of blocks
  int stride = 0;                    ///< of a row, a multiple of kBlock
  std::vector<std::uint8_t> alphas;  ///< of the sprite, row by row
};

/// Parts are numbered in the order of their first pixel, row by row. Cost: about 1 ns a pixel.
void find_parts(const Sprite& sprite, SilhouetteParts& parts);

}  // namespace motex
