// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/sax.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "motex/core/error.h"

namespace motex {
namespace {

double normal_distribution(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

}  // namespace

std::vector<double> sax_breakpoints(int alphabet) {
  if (alphabet < 2 || alphabet > 64)
    throw InvalidInput("an alphabet of " + std::to_string(alphabet) + " letters: use 2 … 64");
  std::vector<double> out;
  for (int k = 1; k < alphabet; ++k) {
    double low = -8, high = 8;
    for (int step = 0; step < 60; ++step) {
      const double middle = (low + high) / 2;
      (normal_distribution(middle) * alphabet < k ? low : high) = middle;
    }
    out.push_back(2 * k == alphabet ? 0 : (low + high) / 2);
  }
  return out;
}

std::vector<double> piecewise_means(const double* x, int size, int segments) {
  std::vector<double> out(static_cast<std::size_t>(segments), 0);
  // In units of 1 / segments of a frame: frame t covers t · segments … (t + 1) · segments, segment k k · size … + size.
  for (int k = 0; k < segments; ++k) {
    double sum = 0;
    for (int t = k * size / segments; t * segments < (k + 1) * size; ++t)
      sum += x[t] * (std::min((t + 1) * segments, (k + 1) * size) - std::max(t * segments, k * size));
    out[static_cast<std::size_t>(k)] = sum / size;
  }
  return out;
}

SaxWords sax_words(const SeriesWindows& windows, int word_length, int alphabet) {
  if (word_length < 1 || word_length > windows.window)
    throw InvalidInput("words of " + std::to_string(word_length) + " letters for windows of " +
                       std::to_string(windows.window) + " frames: use 1 … " + std::to_string(windows.window));
  const std::vector<double> breakpoints = sax_breakpoints(alphabet);
  SaxWords out{word_length, alphabet, {}};
  const auto length = static_cast<std::size_t>(word_length);
  out.letters.assign(static_cast<std::size_t>(windows.num_windows) * length, 255);
  for (int start = 0; start < windows.num_windows; ++start) {
    if (windows.usable[static_cast<std::size_t>(start)] == 0 || windows.deviation(start) == 0) continue;
    const std::vector<double> means = piecewise_means(windows.signal(0) + start, windows.window, word_length);
    for (std::size_t k = 0; k < length; ++k) {
      const double z = (means[k] - windows.mean(0, start)) / windows.deviation(start);
      const auto above = std::upper_bound(breakpoints.begin(), breakpoints.end(), z);
      out.letters[static_cast<std::size_t>(start) * length + k] =
          static_cast<std::uint8_t>(above - breakpoints.begin());
    }
  }
  return out;
}

}  // namespace motex
