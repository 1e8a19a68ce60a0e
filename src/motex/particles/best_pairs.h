// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace motex {

/// A possible pair of row and column and what it is worth.
struct PairGain {
  int row = 0;
  int column = 0;
  double gain = 0;
};

/// Pairs, no row and no column twice, of the largest total gain (exact: shortest augmenting paths through the pairs
/// that exist; cost ~ pairs that compete). Gains ≤ 0 and rows or columns outside the counts are left out. Returns the
/// column of each row, −1 = none.
std::vector<int> best_pairs(int num_rows, int num_columns, const std::vector<PairGain>& gains);

}  // namespace motex
