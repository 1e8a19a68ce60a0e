// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/people/series_windows.h"

namespace motex {

/// Symbolic words of a series' windows (Lin et al. 2003, as Chiu et al. 2003 use them): each window of the first signal
/// is z-normalised, averaged over word_length segments of equal length and each mean becomes a letter of equal
/// probability under the standard normal distribution.
///
/// A word length that does not divide the window shares the frames at a border by the part that lies in each segment;
/// a mean that falls on a breakpoint belongs to the letter above it.
struct SaxWords {
  int word_length = 0;
  int alphabet = 0;
  std::vector<std::uint8_t> letters;  ///< [start · word_length + segment]; windows not usable have letters all 255
};

/// β_1 < … < β_{a−1}: N(0, 1) has 1/a of its mass between neighbours. 2 ≤ a ≤ 64.
std::vector<double> sax_breakpoints(int alphabet);
/// Means of `segments` equal parts of x[0 … size).
std::vector<double> piecewise_means(const double* x, int size, int segments);
/// Throws InvalidInput: word length outside 1 … window, alphabet outside 2 … 64.
SaxWords sax_words(const SeriesWindows& windows, int word_length, int alphabet);

}  // namespace motex
