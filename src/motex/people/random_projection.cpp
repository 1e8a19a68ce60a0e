// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/random_projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/rng.h"
#include "motex/people/motifs.h"
#include "motex/people/sax.h"

namespace motex {
namespace {

constexpr std::size_t kLargestBucket = 300;  // words that so many windows share tell nothing
constexpr int kFewestTried = 400, kMostTried = 20000;
constexpr std::size_t kExemplars = 300;

using Key = std::uint64_t;

/// Starts of runs of windows with one word.
std::vector<int> first_of_runs(const SaxWords& words, int num_windows) {
  const auto length = static_cast<std::size_t>(words.word_length);
  std::vector<int> out;
  for (int start = 0; start < num_windows; ++start) {
    const std::uint8_t* word = words.letters.data() + static_cast<std::size_t>(start) * length;
    if (word[0] == 255) continue;
    if (start > 0 && std::equal(word, word + length, word - length)) continue;
    out.push_back(start);
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

std::vector<Collision> matrix_of(const std::vector<std::pair<Key, int>>& counts) {
  std::vector<Collision> out;
  out.reserve(counts.size());
  for (const auto& [pair, count] : counts)
    out.push_back({static_cast<int>(pair >> 32U), static_cast<int>(pair & 0xffffffffU), count});
  return out;
}

/// A run of equal words stands for all its windows: the closest pair around, by steps of 4, 2 and 1 frames.
double closest_around(const SeriesWindows& windows, int& a, int& b, int& num_compared) {
  constexpr std::array<std::pair<int, int>, 8> kSteps{
      {{0, 1}, {1, 0}, {0, -1}, {-1, 0}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
  const auto distance_at = [&](int i, int j) {
    const bool fits = i >= 0 && j < windows.num_windows && j - i >= windows.window;
    if (!fits || windows.usable[static_cast<std::size_t>(i)] == 0 || windows.usable[static_cast<std::size_t>(j)] == 0)
      return std::numeric_limits<double>::infinity();
    ++num_compared;
    return windows.distance(i, j);
  };
  double best = distance_at(a, b);
  for (int size = 4; size >= 1; size /= 2)
    for (bool moved = true; moved;) {
      moved = false;
      for (const auto& [down, across] : kSteps) {
        const double distance = distance_at(a + size * down, b + size * across);
        if (distance >= best) continue;
        best = distance;
        a += size * down;
        b += size * across;
        moved = true;
        break;
      }
    }
  return best;
}

/// Matches within `radius` (times √window) of the exemplar, itself included, at least a window apart.
std::vector<Occurrence> non_trivial_matches(const SeriesWindows& windows, int exemplar, double radius) {
  const double root = std::sqrt(static_cast<double>(windows.window));
  std::vector<Occurrence> near;
  for (int start = 0; start < windows.num_windows; ++start) {
    if (windows.usable[static_cast<std::size_t>(start)] == 0) continue;
    const double distance = start == exemplar ? 0 : windows.distance(exemplar, start) / root;
    if (distance <= radius) near.push_back({start, windows.window, distance});
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const Occurrence& a, const Occurrence& b) { return a.distance < b.distance; });
  std::vector<Occurrence> out;
  for (const Occurrence& match : near)
    if (std::none_of(out.begin(), out.end(),
                     [&](const Occurrence& other) { return std::abs(match.start - other.start) < windows.window; }))
      out.push_back(match);
  return out;
}

/// The most matches first; each more than 2R from all before and apart from what they hold.
std::vector<Motif> best_motifs(const SeriesWindows& windows, const std::vector<int>& exemplars, double radius,
                               int max_motifs) {
  std::vector<std::pair<int, std::vector<Occurrence>>> all;
  for (const int exemplar : exemplars) {
    std::vector<Occurrence> matches = non_trivial_matches(windows, exemplar, radius);
    if (matches.size() > 1) all.emplace_back(exemplar, std::move(matches));
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::pair(b.second.size(), a.second[1].distance) < std::pair(a.second.size(), b.second[1].distance);
  });
  const double root = std::sqrt(static_cast<double>(windows.window));
  std::vector<Motif> out;
  for (auto& [exemplar, matches] : all) {
    if (static_cast<int>(out.size()) == max_motifs) break;
    const bool is_new = std::none_of(out.begin(), out.end(), [&, at = exemplar](const Motif& motif) {
      return std::abs(motif.exemplar - at) < windows.window ||
             windows.distance(motif.exemplar, at) / root <= 2 * radius;
    });
    if (!is_new) continue;
    Motif motif;
    motif.letter = motif_letter(static_cast<int>(out.size()));
    motif.window = windows.window;
    motif.radius = radius;
    motif.exemplar = exemplar;
    motif.distance = matches[1].distance;
    std::sort(matches.begin(), matches.end(),
              [](const Occurrence& a, const Occurrence& b) { return a.start < b.start; });
    motif.occurrences = std::move(matches);
    out.push_back(std::move(motif));
  }
  return out;
}

/// Windows in which most pairs of many collisions end, less those next to one chosen before.
std::vector<int> exemplars_of(const std::vector<Collision>& collisions, int num_windows) {
  std::vector<double> weight(static_cast<std::size_t>(num_windows), 0);
  for (const Collision& collision : collisions) {
    const double votes = static_cast<double>(collision.count) * collision.count;
    weight[static_cast<std::size_t>(collision.row)] += votes;
    weight[static_cast<std::size_t>(collision.column)] += votes;
  }
  std::vector<int> order;
  for (int start = 0; start < num_windows; ++start)
    if (weight[static_cast<std::size_t>(start)] > 0) order.push_back(start);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return weight[static_cast<std::size_t>(a)] > weight[static_cast<std::size_t>(b)];
  });
  if (order.size() > kExemplars) order.resize(kExemplars);
  return order;
}

void find_closest(const SeriesWindows& windows, std::vector<Collision> order, RandomProjectionReport& report) {
  std::stable_sort(order.begin(), order.end(),
                   [](const Collision& a, const Collision& b) { return a.count > b.count; });
  double best = std::numeric_limits<double>::infinity();
  int last_gain = 0;
  const int most = std::min<int>(kMostTried, static_cast<int>(order.size()));
  for (int tried = 0; tried < most && (tried < kFewestTried || tried < 2 * last_gain); ++tried) {
    int a = order[static_cast<std::size_t>(tried)].row, b = order[static_cast<std::size_t>(tried)].column;
    const double distance = closest_around(windows, a, b, report.num_compared);
    if (distance >= best) continue;
    best = distance;
    last_gain = tried;
    report.first = a;
    report.second = b;
  }
  if (report.first >= 0) report.distance = best / std::sqrt(static_cast<double>(windows.window));
}

}  // namespace

RandomProjectionReport random_projection_motifs(const SeriesWindows& windows, const RandomProjectionOptions& options,
                                                const JobContext& job) {
  check_options(options);
  if (windows.num_signals != 1) throw InvalidInput("random projection takes one signal: choose one");
  const int word_length = std::min(options.word_length, windows.window);
  const int mask_size = std::min({options.mask_size, word_length - 1, 12});
  const SaxWords words = sax_words(windows, word_length, options.alphabet);
  const std::vector<int> starts = first_of_runs(words, windows.num_windows);
  RandomProjectionReport report;
  std::vector<std::pair<Key, int>> counts;
  Rng rng(options.seed);
  for (int iteration = 1; iteration <= options.iterations; ++iteration) {
    job.check_cancelled();
    job.progress("random projection", static_cast<double>(iteration) / options.iterations);
    std::vector<int> mask(static_cast<std::size_t>(word_length));
    std::iota(mask.begin(), mask.end(), 0);
    for (int k = 0; k < mask_size; ++k)
      std::swap(mask[static_cast<std::size_t>(k)],
                mask[static_cast<std::size_t>(k) + rng.below(static_cast<std::uint64_t>(word_length - k))]);
    mask.resize(static_cast<std::size_t>(mask_size));
    add(counts, collide(words, starts, mask, windows.window));
    if (iteration == (options.iterations + 3) / 4 || iteration == (options.iterations + 1) / 2 ||
        iteration == options.iterations)
      report.collisions.push_back(matrix_of(counts));
  }
  find_closest(windows, report.collisions.back(), report);
  report.radius = options.radius > 0 ? options.radius : 2 * report.distance;
  report.motifs = best_motifs(windows, exemplars_of(report.collisions.back(), windows.num_windows), report.radius,
                              options.max_motifs);
  return report;
}

std::vector<Motif> exhaustive_motifs(const SeriesWindows& windows, double radius, int max_motifs) {
  std::vector<int> all;
  for (int start = 0; start < windows.num_windows; ++start)
    if (windows.usable[static_cast<std::size_t>(start)] != 0) all.push_back(start);
  return best_motifs(windows, all, radius, max_motifs);
}

}  // namespace motex
