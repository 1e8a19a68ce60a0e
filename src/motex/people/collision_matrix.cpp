// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/collision_matrix.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "motex/core/rng.h"

namespace motex {
namespace {

constexpr std::size_t kLargestBucket = 300;  // words that so many windows share tell nothing
constexpr double kReach = 0.04;              // of a window, along the diagonal

using Key = std::uint64_t;

/// First window of the run of equal words that each window lies in; −1 = not usable.
std::vector<int> run_starts(const SaxWords& words, int num_windows) {
  const auto length = static_cast<std::size_t>(words.word_length);
  std::vector<int> out(static_cast<std::size_t>(num_windows), -1);
  for (std::size_t start = 0; start < out.size(); ++start) {
    const std::uint8_t* word = words.letters.data() + start * length;
    if (word[0] == 255) continue;
    const bool goes_on = start > 0 && std::equal(word, word + length, word - length);
    out[start] = goes_on ? out[start - 1] : static_cast<int>(start);
  }
  return out;
}

/// Pairs that agree under one mask, as row · 2³² + column, rising.
std::vector<Key> collide(const SaxWords& words, const std::vector<int>& starts, const std::vector<int>& mask,
                         int window) {
  std::vector<std::pair<Key, int>> keys;
  keys.reserve(starts.size());
  for (const int start : starts) {
    Key key = 0;
    for (const int place : mask)
      key = key * 32 + words.letters[static_cast<std::size_t>(start) * static_cast<std::size_t>(words.word_length) +
                                     static_cast<std::size_t>(place)];
    keys.emplace_back(key, start);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Key> pairs;
  for (std::size_t first = 0; first < keys.size();) {
    std::size_t end = first;
    while (end < keys.size() && keys[end].first == keys[first].first) ++end;
    if (end - first <= kLargestBucket)
      for (std::size_t a = first; a < end; ++a)
        for (std::size_t b = a + 1; b < end; ++b)
          if (keys[b].second - keys[a].second >= window)
            pairs.push_back((static_cast<Key>(keys[a].second) << 32U) | static_cast<Key>(keys[b].second));
    first = end;
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Adds one to the count of each pair; both sorted.
void add(std::vector<std::pair<Key, int>>& counts, const std::vector<Key>& pairs) {
  std::vector<std::pair<Key, int>> out;
  out.reserve(counts.size() + pairs.size());
  auto at = counts.begin();
  for (const Key pair : pairs) {
    while (at != counts.end() && at->first < pair) out.push_back(*at++);
    if (at != counts.end() && at->first == pair)
      out.emplace_back(pair, at++->second + 1);
    else
      out.emplace_back(pair, 1);
  }
  out.insert(out.end(), at, counts.end());
  counts = std::move(out);
}

CollisionMatrix matrix_of(const std::vector<std::pair<Key, int>>& counts, int iteration) {
  CollisionMatrix out{iteration, {}};
  out.cells.reserve(counts.size());
  for (const auto& [pair, count] : counts)
    out.cells.push_back({static_cast<int>(pair >> 32U), static_cast<int>(pair & 0xffffffffU), count});
  return out;
}

std::vector<int> random_mask(int word_length, int mask_size, Rng& rng) {
  std::vector<int> mask(static_cast<std::size_t>(word_length));
  std::iota(mask.begin(), mask.end(), 0);
  for (int k = 0; k < mask_size; ++k)
    std::swap(mask[static_cast<std::size_t>(k)],
              mask[static_cast<std::size_t>(k) + rng.below(static_cast<std::uint64_t>(word_length - k))]);
  mask.resize(static_cast<std::size_t>(mask_size));
  return mask;
}

int count_at(const CollisionMatrix& matrix, int row, int column) {
  const auto at = std::lower_bound(
      matrix.cells.begin(), matrix.cells.end(), std::pair(row, column),
      [](const Collision& cell, const std::pair<int, int>& place) { return std::pair(cell.row, cell.column) < place; });
  return at != matrix.cells.end() && at->row == row && at->column == column ? at->count : 0;
}

void keep_most(std::vector<Collision>& cells, std::size_t most) {
  std::stable_sort(cells.begin(), cells.end(),
                   [](const Collision& a, const Collision& b) { return a.count > b.count; });
  if (cells.size() > most) cells.resize(most);
}

}  // namespace

std::vector<CollisionMatrix> count_collisions(const SeriesWindows& windows, const SaxWords& words, int mask_size,
                                              int iterations, std::uint64_t seed, const JobContext& job) {
  std::vector<int> starts = run_starts(words, windows.num_windows);
  starts.erase(std::remove(starts.begin(), starts.end(), -1), starts.end());
  starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
  std::vector<CollisionMatrix> out;
  std::vector<std::pair<Key, int>> counts;
  Rng rng(seed);
  for (int iteration = 1; iteration <= iterations; ++iteration) {
    job.check_cancelled();
    job.progress("random projection", static_cast<double>(iteration) / iterations);
    add(counts, collide(words, starts, random_mask(words.word_length, mask_size, rng), windows.window));
    if (iteration == (iterations + 3) / 4 || iteration == (iterations + 1) / 2 || iteration == iterations)
      out.push_back(matrix_of(counts, iteration));
  }
  return out;
}

std::vector<Collision> ranked_cells(const CollisionMatrix& matrix, const SeriesWindows& windows, const SaxWords& words,
                                    std::size_t most) {
  std::vector<Collision> out = matrix.cells;
  keep_most(out, most);
  const std::vector<int> run = run_starts(words, windows.num_windows);
  const int reach = std::max(1, static_cast<int>(std::lround(kReach * windows.window)));
  for (Collision& cell : out) {
    int sum = 0;
    for (int k = -reach; k <= reach; ++k) {
      if (cell.row + k < 0 || cell.column + k >= windows.num_windows) continue;
      const int row = run[static_cast<std::size_t>(cell.row + k)];
      const int column = run[static_cast<std::size_t>(cell.column + k)];
      if (row >= 0 && column >= 0) sum += (reach + 1 - std::abs(k)) * count_at(matrix, row, column);
    }
    cell.count = sum;
  }
  keep_most(out, out.size());
  return out;
}

}  // namespace motex
