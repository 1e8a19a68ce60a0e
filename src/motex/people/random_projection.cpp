// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/random_projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/people/sax.h"

namespace motex {
namespace {

constexpr int kLargestAlphabet = 16, kSmallestAlphabet = 4;
constexpr std::size_t kFewestCompared = 1000, kMostCompared = 20000, kSearchedAround = 20;
constexpr std::size_t kExemplars = 300, kMostCandidates = 10;

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

/// A window that may stand for a motif.
struct Exemplar {
  int start = 0;
  std::vector<Occurrence> matches;                           ///< within R, itself first, at least a window apart
  double nearest = std::numeric_limits<double>::infinity();  ///< of all at least a window away, / √window
};

Exemplar with_matches(const SeriesWindows& windows, int exemplar, double radius) {
  const double root = std::sqrt(static_cast<double>(windows.window));
  Exemplar out{exemplar, {}};
  std::vector<Occurrence> near;
  for (int start = 0; start < windows.num_windows; ++start) {
    if (windows.usable[static_cast<std::size_t>(start)] == 0) continue;
    const double distance = start == exemplar ? 0 : windows.distance(exemplar, start) / root;
    if (std::abs(start - exemplar) >= windows.window) out.nearest = std::min(out.nearest, distance);
    if (distance <= radius) near.push_back({start, windows.window, distance});
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const Occurrence& a, const Occurrence& b) { return a.distance < b.distance; });
  for (const Occurrence& match : near)
    if (std::none_of(out.matches.begin(), out.matches.end(),
                     [&](const Occurrence& other) { return std::abs(match.start - other.start) < windows.window; }))
      out.matches.push_back(match);
  return out;
}

struct Choice {
  std::vector<Motif> motifs;
  std::vector<MotifCandidate> candidates;
};

Motif motif_of(const Exemplar& exemplar, int window, double radius, int idx) {
  Motif motif;
  motif.letter = motif_letter(idx);
  motif.window = window;
  motif.radius = radius;
  motif.exemplar = exemplar.start;
  motif.distance = exemplar.nearest;
  motif.occurrences = exemplar.matches;
  std::sort(motif.occurrences.begin(), motif.occurrences.end(),
            [](const Occurrence& a, const Occurrence& b) { return a.start < b.start; });
  return motif;
}

/// Told once a place, and not where a motif was found.
void refuse(const Exemplar& exemplar, int window, std::string reason, Choice& choice) {
  const auto is_there = [&](int start) { return std::abs(start - exemplar.start) < window; };
  if (choice.candidates.size() == kMostCandidates) return;
  for (const Motif& motif : choice.motifs)
    if (is_there(motif.exemplar)) return;
  for (const MotifCandidate& candidate : choice.candidates)
    for (const int start : candidate.starts)
      if (is_there(start)) return;
  MotifCandidate candidate{window, exemplar.nearest, {}, std::move(reason)};
  for (const Occurrence& match : exemplar.matches) candidate.starts.push_back(match.start);
  std::sort(candidate.starts.begin(), candidate.starts.end());
  choice.candidates.push_back(std::move(candidate));
}

std::string decimals(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", value);
  return text;
}

/// The most matches first; each more than 2R from all before, and sharing at most half of its frames with what they
/// hold.
Choice best_motifs(const SeriesWindows& windows, const std::vector<int>& starts, double radius, int max_motifs) {
  std::vector<Exemplar> all;
  for (const int start : starts) all.push_back(with_matches(windows, start, radius));
  std::stable_sort(all.begin(), all.end(), [](const Exemplar& a, const Exemplar& b) {
    return std::pair(b.matches.size(), a.nearest) < std::pair(a.matches.size(), b.nearest);
  });
  const double root = std::sqrt(static_cast<double>(windows.window));
  Choice out;
  for (const Exemplar& exemplar : all) {
    const auto known = std::find_if(out.motifs.begin(), out.motifs.end(), [&](const Motif& motif) {
      return std::abs(motif.exemplar - exemplar.start) < windows.window ||
             windows.distance(motif.exemplar, exemplar.start) / root <= 2 * radius;
    });
    const auto holder = std::find_if(out.motifs.begin(), out.motifs.end(), [&](const Motif& motif) {
      return std::any_of(motif.occurrences.begin(), motif.occurrences.end(), [&](const Occurrence& occurrence) {
        return std::abs(occurrence.start - exemplar.start) < windows.window / 2;
      });
    });
    std::string reason;
    if (exemplar.matches.size() < 2)
      reason = "too few: the nearest window lies at " + decimals(exemplar.nearest) + ", R is " + decimals(radius);
    else if (known != out.motifs.end())
      reason = "within 2R of the motif at frame " + std::to_string(known->exemplar) + ": it lies at " +
               decimals(windows.distance(known->exemplar, exemplar.start) / root) + ", 2R is " + decimals(2 * radius);
    else if (holder != out.motifs.end())
      reason = "overlaps an occurrence of the motif at frame " + std::to_string(holder->exemplar);
    else if (static_cast<int>(out.motifs.size()) == max_motifs)
      reason = "more than K = " + std::to_string(max_motifs) + ": those found occur at least as often";
    if (reason.empty())
      out.motifs.push_back(motif_of(exemplar, windows.window, radius, static_cast<int>(out.motifs.size())));
    else
      refuse(exemplar, windows.window, std::move(reason), out);
  }
  return out;
}

/// Windows in which most pairs of many collisions end.
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

void find_closest(const SeriesWindows& windows, const std::vector<Collision>& cells, RandomProjectionReport& report) {
  const double root = std::sqrt(static_cast<double>(windows.window));
  std::vector<WindowPair> pairs;
  double best = std::numeric_limits<double>::infinity();
  std::size_t enough = kFewestCompared;
  for (std::size_t k = 0; k < std::min(cells.size(), enough); ++k) {
    pairs.push_back({cells[k].row, cells[k].column, windows.distance(cells[k].row, cells[k].column) / root});
    if (pairs[k].distance >= best) continue;
    best = pairs[k].distance;
    enough = std::max(kFewestCompared, 2 * k);
  }
  report.num_compared = static_cast<int>(pairs.size());
  if (pairs.empty()) return;
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const WindowPair& a, const WindowPair& b) { return a.distance < b.distance; });
  report.in_matrix = report.closest = pairs[0];
  pairs.resize(std::min(pairs.size(), kSearchedAround));
  for (WindowPair& pair : pairs) {
    pair.distance = closest_around(windows, pair.first, pair.second, report.num_compared) / root;
    if (pair.distance < report.closest.distance) report.closest = pair;
  }
}

}  // namespace

RandomProjectionReport random_projection_motifs(const SeriesWindows& windows, const RandomProjectionOptions& options,
                                                const JobContext& job) {
  check_options(options);
  if (windows.num_signals != 1) throw InvalidInput("random projection takes one signal: choose one");
  const int word_length = std::min(options.word_length, windows.window);
  const int mask_size = std::min({options.mask_size, word_length - 1, 12});
  RandomProjectionReport report;
  SaxWords words;
  for (report.alphabet = options.alphabet > 0 ? options.alphabet : kLargestAlphabet;; report.alphabet /= 2) {
    words = sax_words(windows, word_length, report.alphabet);
    report.collisions = count_collisions(windows, words, mask_size, options.iterations, options.seed, job);
    const bool is_enough = report.collisions.back().cells.size() >= kFewestCompared;
    if (options.alphabet > 0 || is_enough || report.alphabet <= kSmallestAlphabet) break;
  }
  const CollisionMatrix& all = report.collisions.back();
  find_closest(windows, ranked_cells(all, windows, words, kMostCompared), report);
  report.radius = options.radius > 0 ? options.radius : 2 * report.closest.distance;
  Choice choice = best_motifs(windows, exemplars_of(all.cells, windows.num_windows), report.radius, options.max_motifs);
  report.motifs = std::move(choice.motifs);
  report.candidates = std::move(choice.candidates);
  return report;
}

std::vector<Motif> exhaustive_motifs(const SeriesWindows& windows, double radius, int max_motifs) {
  std::vector<int> all;
  for (int start = 0; start < windows.num_windows; ++start)
    if (windows.usable[static_cast<std::size_t>(start)] != 0) all.push_back(start);
  return best_motifs(windows, all, radius, max_motifs).motifs;
}

}  // namespace motex
