// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/core/matrix.h"

namespace motex {

/// Maximum of the last `window` pushed rows, for every lane (column) by itself, and where it was:
///
///   value[i] = max row_p[i],  last − window < p ≤ last
///
/// Pushed rows are cut into blocks of `window`. Every window is a tail of one block and a head of the next, whose
/// maxima are kept as suffix and running maxima: three comparisons a lane and row, whatever the window, and no
/// branches.
class SlidingMaximum {
 public:
  /// window ≥ 1, or 0 for all rows since the start.
  SlidingMaximum(Index num_lanes, Index window);

  /// The row gets position 0, 1, 2 … NaN is not allowed; −∞ is "no candidate".
  void push(const double* row);
  /// The lane's rows pushed so far count no more.
  void forget(Index lane);

  const std::vector<double>& values() const { return values_; }
  /// −1 where no candidate was seen; of equal values the earliest.
  const std::vector<std::int32_t>& positions() const { return positions_; }

 private:
  void push_windowed(const double* row);
  void make_suffix_maxima(std::int32_t block_start);

  Index num_lanes_;
  Index window_;
  std::int32_t num_pushed_ = 0;
  std::vector<double> values_, head_values_;
  std::vector<std::int32_t> positions_, head_positions_;
  std::vector<double> block_values_;  // window × lanes: before offset, rows of this block; after, tails of the last
  std::vector<std::int32_t> block_positions_;  // likewise
  std::vector<std::int32_t> first_counted_;    // rows of a lane before this one were forgotten
};

}  // namespace motex
