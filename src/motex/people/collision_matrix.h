// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "motex/core/job.h"
#include "motex/people/sax.h"
#include "motex/people/series_windows.h"

namespace motex {

/// One entry of the collision matrix, above the diagonal.
struct Collision {
  int row = 0, column = 0;  ///< first windows of two runs of equal words, row < column
  int count = 0;            ///< masks under which their words are equal
};

/// How often pairs of windows fell together in the iterations so far; pairs that never did are left out.
struct CollisionMatrix {
  int iteration = 0;
  std::vector<Collision> cells;  ///< by row, then column
};

/// The collision matrix of random projection [Chiu, Keogh, Lonardi 2003] after a quarter, half and all iterations: in
/// each, `mask_size` letters drawn at random are looked at, and windows whose words agree in them collide. Runs of
/// windows with one word count once (their first window); windows less than one window apart are trivial matches that
/// never collide; words that more than 300 runs share under a mask are passed over. At most 12 letters of a mask.
std::vector<CollisionMatrix> count_collisions(const SeriesWindows& windows, const SaxWords& words, int mask_size,
                                              int iterations, std::uint64_t seed, const JobContext& job = {});

/// The `most` cells of most collisions, best first. Many counts are equal, so the 20 × `most` first are ranked by a sum
/// along the diagonal, Σ_k (h + 1 − |k|) count(row + k, column + k), |k| ≤ h = 4 % of the window: windows that resemble
/// one another still do a frame later. `count` becomes that sum.
std::vector<Collision> ranked_cells(const CollisionMatrix& matrix, const SeriesWindows& windows, const SaxWords& words,
                                    std::size_t most);

}  // namespace motex
