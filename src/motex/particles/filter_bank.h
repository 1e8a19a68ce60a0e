// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/base.h"

namespace motex {

enum class Dictionary { kPaper, kExtended };

/// The filters of one pyramid level: those whose scale is 1 … 1.5 pixels there (finer ones are on level 0).
struct LevelFilters {
  int level = 0;
  int step = 1;             ///< 2^level pixels of the image
  std::vector<Base> bases;  ///< centred at 0
  std::vector<float> taps;  ///< kWindow² × bases, row-major: response = window · taps
};

/// Side of the square in which filters are sampled, in pixels of their level.
constexpr int kFilterReach = 8;
constexpr int kFilterWindow = 2 * kFilterReach + 1;

/// The dictionary Δ of [TM02] section 2 as matched filters on a Gaussian pyramid: 8 scales 0.75 … 8 px (ratio 1.4),
/// LoG + 12 Gcos + 12 Gsin each, 200 in all; kExtended adds a Gaussian per scale: 208.
/// The response to α b is α at the centre of b (up to 1.1 α where another filter answers, since windows cut off the
/// ends of long bars). Positions lie on the pixels of the level; refinement does the rest. Levels that an image of that
/// size is too small for are left out.
std::vector<LevelFilters> make_filter_bank(Dictionary dictionary, int width, int height);

}  // namespace motex
