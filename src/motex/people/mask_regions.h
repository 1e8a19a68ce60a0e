// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/image/mask.h"
#include "motex/people/region_runs.h"

namespace motex {

/// A connected set of pixels of one value: 8 neighbours where they are in the mask, 4 where they are not.
struct MaskRegion {
  bool value = false;
  bool at_border = false;  ///< has a pixel at a border of the mask
  std::int64_t area = 0;
};

/// A mask taken apart into all its regions. Kept between frames it allocates nothing.
struct MaskRegions {
  std::vector<RegionRun> runs;  ///< from the top, from the left; they cover the mask
  std::vector<MaskRegion> regions;
};

/// Regions are numbered in the order of their first pixel, row by row.
void find_regions(const Mask& mask, MaskRegions& found);

}  // namespace motex
