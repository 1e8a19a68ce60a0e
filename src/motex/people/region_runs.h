// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace motex {

/// Pixels of one row that lie side by side and have one value.
struct RegionRun {
  int y = 0;
  int first = 0, last = 0;  ///< x of both ends
  bool value = true;
  int region = 0;  ///< its number; while runs are still being joined: the index of a run of its region, at most its own
};

/// Joins the runs of a row, those from `begin` on, with the runs of the row above, those from `above` to `begin`, where
/// they touch and have one value: by a corner too where the value is true, only by a side where it is false.
/// Each run of the row comes in with region = its own index.
void join_rows(std::vector<RegionRun>& runs, std::size_t above, std::size_t begin);

/// Numbers the regions of joined runs in the order of their first pixel, row by row; returns how many there are.
int number_regions(std::vector<RegionRun>& runs);

}  // namespace motex
