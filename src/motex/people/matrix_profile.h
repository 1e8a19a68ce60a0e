// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/people/series_windows.h"

namespace motex {

/// Distance of every window to the one that resembles it most.
struct MatrixProfile {
  int window = 0;                ///< m, frames
  int exclusion = 0;             ///< windows up to so many frames apart are not compared
  std::vector<double> distance;  ///< Euclidean, both z-normalised, 0 … 2 √m; infinite where nothing can be compared
  std::vector<int> nearest;      ///< start of the one that resembles it most; −1 = none
};

/// Two windows whose starts lie up to so many frames apart are trivial matches of one another: a quarter of the window,
/// rounded up, as the field does.
int default_exclusion(int window);

/// The exact matrix profile of a series with itself: every pair of usable windows more than `exclusion` frames apart
/// (−1 = default_exclusion()) is compared, in double precision, along diagonals by
///   cov(i, j) = cov(i − 1, j − 1) + f_i g_j + f_j g_i,  f_i = (x_{i+m−1} − x_{i−1}) / 2,
///   g_i = (x_{i+m−1} − μ_i) + (x_{i−1} − μ_{i−1}),
/// begun anew every few thousand rows; the distance of the nearest is computed from the numbers themselves. The result
/// does not depend on the number of threads or on the machine's vector unit. Cost windows² / 2 · S multiply-adds;
/// memory a few arrays of the series' length a thread.
MatrixProfile matrix_profile(const SeriesWindows& windows, int exclusion = -1, const JobContext& job = {});

}  // namespace motex
