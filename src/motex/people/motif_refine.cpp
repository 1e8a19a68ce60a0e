// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/motif_refine.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "motex/people/motif_gather.h"
#include "motex/people/motif_join.h"
#include "motex/people/motif_occurrences.h"

namespace motex {
namespace {

constexpr double kRepeats = 0.7071;  // more than half of what a piece moves is the same every time
constexpr double kMoves = 0.05;      // variance in a piece / in the window: less is rest or a turning point
constexpr double kHalved = 2;        // two performances lie √2 times as far apart as each from their mean
constexpr double kPieceSecs = 0.2;
constexpr double kSharedPiece = 0.2;  // with another performance: that piece is not free

/// Frames start … start + length − 1 in `rows` rows, less their means.
FrameMatrix sampled(const MotifSearch& search, int start, int length, int rows) {
  FrameMatrix out(rows, search.series.cols());
  for (int t = 0; t < rows; ++t) {
    const double at = start + t * (length - 1.0) / std::max(1, rows - 1);
    const auto low = std::min<Index>(static_cast<Index>(at), start + length - 2);
    const double part = at - static_cast<double>(low);
    out.row(t) = (1 - part) * search.series.row(low) + part * search.series.row(low + 1);
  }
  out.rowwise() -= out.colwise().mean().eval();
  return out;
}

/// The means of first and second halves lie no farther apart than two performances.
bool same_halves(const MotifSearch& search, const Motif& halved) {
  const auto n = static_cast<double>(halved.occurrences.size()) / 2;
  if (n < 2) return false;
  std::vector<FrameMatrix> all;
  FrameMatrix mean[2] = {FrameMatrix::Zero(halved.window, search.series.cols()),
                         FrameMatrix::Zero(halved.window, search.series.cols())};
  for (std::size_t k = 0; k < halved.occurrences.size(); ++k) {
    const Occurrence &a = halved.occurrences[k - k % 2], &b = halved.occurrences[k - k % 2 + 1],
                     &one = halved.occurrences[k];
    const double amplitude = search.frames.amplitude(a.start, a.length) + search.frames.amplitude(b.start, b.length);
    all.emplace_back(sampled(search, one.start, one.length, halved.window) / amplitude);
    mean[k % 2] += all.back() / n;
  }
  double within = 0;
  for (std::size_t k = 0; k < all.size(); ++k) within += (all[k] - mean[k % 2]).squaredNorm() / (2 * (n - 1));
  return (mean[0] - mean[1]).squaredNorm() <= 2 * within;
}

/// Two halves that resemble each other are two performances.
bool halve(const MotifSearch& search, Motif& motif) {
  const int half = motif.window / 2;
  if (half < 4 || half < search.options.min_secs * search.options.frames_per_sec) return false;
  std::vector<Occurrence> first;
  for (const Occurrence& one : motif.occurrences) first.push_back({one.start, one.length / 2, 0});
  const Pattern mean = mean_of(search, first, half);
  std::vector<Occurrence> halves;
  std::size_t both = 0;
  for (const Occurrence& one : motif.occurrences) {
    const Match a = search.frames.closest(mean, one.start + one.length / 4, half / 4);
    const Match b = search.frames.closest(mean, one.start + 3 * one.length / 4, half / 4);
    if (a.correlation < kAgree || b.correlation < kAgree) continue;
    if (!is_as_strong(search.frames.amplitude(a.start, a.length), search.frames.amplitude(b.start, b.length))) continue;
    ++both;
    halves.push_back({a.start, a.length, 0});
    halves.push_back({b.start, b.length, 0});
  }
  if (3 * both < 2 * motif.occurrences.size()) return false;
  Motif halved = motif;
  halved.occurrences = std::move(halves);
  halved.window = half;
  if (!same_halves(search, halved) || spread(search, halved) > kHalved * spread(search, motif)) return false;
  motif = std::move(halved);
  return true;
}

/// Rows `from` … `from + rows − 1` of the window, in every occurrence where they are known and no other's: less their
/// means, over the occurrence's amplitude.
std::vector<FrameMatrix> pieces_of(const MotifSearch& search, const Motif& motif, int from, int rows) {
  std::vector<FrameMatrix> pieces;
  for (std::size_t k = 0; k < motif.occurrences.size(); ++k) {
    const Occurrence& one = motif.occurrences[k];
    const double step = static_cast<double>(one.length) / motif.window;
    const int start = one.start + static_cast<int>(std::lround(from * step)),
              length = std::max(2, static_cast<int>(std::lround(rows * step))), first = std::min(start, one.start),
              end = std::max(start + length, one.start + one.length);
    if (start < 0 || !search.frames.whole(first, end - first)) continue;
    bool is_another = false;
    for (std::size_t j = 0; j < motif.occurrences.size(); ++j) {
      const Occurrence& other = motif.occurrences[j];
      const int shared = std::min(start + length, other.start + other.length) - std::max(start, other.start);
      is_another = is_another || (j != k && shared > kSharedPiece * length);
    }
    if (is_another) continue;
    const double scale = search.frames.amplitude(one.start, one.length) * std::sqrt(static_cast<double>(rows));
    pieces.emplace_back(sampled(search, start, length, rows) / scale);
  }
  return pieces;
}

/// Do the pieces of most occurrences move, and alike?
bool agree(const MotifSearch& search, const Motif& motif, int from, int rows) {
  const std::vector<FrameMatrix> pieces = pieces_of(search, motif, from, rows);
  const auto n = static_cast<double>(pieces.size());
  if (pieces.size() < 2 || 2 * pieces.size() <= motif.occurrences.size()) return false;
  FrameMatrix sum = FrameMatrix::Zero(rows, search.series.cols());
  double energy = 0;
  for (const FrameMatrix& piece : pieces) {
    sum += piece;
    energy += piece.squaredNorm();
  }
  if (energy < kMoves * n) return false;
  const double pairs = (sum.squaredNorm() - energy) / ((n - 1) * energy);
  return pairs > 0 && pairs * std::sqrt((n - 1) / (1 + (n - 2) * pairs)) >= kRepeats;
}

/// The window grows on both sides as long as what is added moves and agrees.
void grow_window(const MotifSearch& search, Motif& motif) {
  const int piece = std::max(4, static_cast<int>(std::lround(kPieceSecs * search.options.frames_per_sec)));
  const int longest = static_cast<int>(search.options.max_secs * search.options.frames_per_sec);
  bool open[2] = {true, true};
  while (open[0] || open[1]) {
    for (const int side : {0, 1}) {
      if (!open[side]) continue;
      open[side] = false;
      const int furthest = std::max(piece, motif.window / 2);
      for (int rows = piece; rows <= furthest && motif.window + rows <= longest; rows += piece) {
        Motif larger = motif;
        for (Occurrence& one : larger.occurrences) {
          const int more = static_cast<int>(std::lround(static_cast<double>(rows) * one.length / motif.window));
          if (side == 0) one.start -= more;
          one.length += more;
        }
        larger.window += rows;
        align(search, larger);
        if (!agree(search, larger, side == 0 ? 0 : motif.window, rows)) continue;
        if (1 - spread(search, larger) / 2 < kAgree) continue;
        motif = std::move(larger);
        open[side] = true;
        break;
      }
    }
  }
}

/// Leaves out what no longer resembles the others; false: nothing repeats any more.
bool verify(const MotifSearch& search, Motif& motif) {
  if (motif.occurrences.size() < 2) return false;
  const std::vector<double> correlation = correlations(search, motif);
  std::vector<Occurrence> kept;
  std::size_t known = 0;
  for (std::size_t k = 0; k < correlation.size(); ++k) {
    const bool is_whole = correlation[k] > -1;
    if (is_whole && correlation[k] < kAgree) continue;
    kept.push_back(motif.occurrences[k]);
    known += is_whole ? 1 : 0;
  }
  motif.occurrences = std::move(kept);
  return known >= 2;
}

/// Who explains most frames keeps them.
void share_out(const MotifSearch& search, std::vector<Motif>& motifs) {
  const auto weight = [](const Motif& motif) {
    return static_cast<double>(motif.window) * static_cast<double>(motif.occurrences.size());
  };
  std::stable_sort(motifs.begin(), motifs.end(), [&](const Motif& a, const Motif& b) { return weight(a) > weight(b); });
  std::vector<Motif> kept;
  for (Motif& motif : motifs) {
    std::vector<Occurrence> own;
    for (const Occurrence& one : motif.occurrences) {
      if (is_free(search, own, one) && is_free(search, kept, one)) own.push_back(one);
    }
    motif.occurrences = std::move(own);
    if (!verify(search, motif)) continue;
    kept.push_back(std::move(motif));
  }
  motifs = std::move(kept);
}

void measure(const MotifSearch& search, Motif& motif) {
  std::sort(motif.occurrences.begin(), motif.occurrences.end(),
            [](const Occurrence& a, const Occurrence& b) { return a.start < b.start; });
  const std::vector<double> correlation = correlations(search, motif);
  motif.distance = HUGE_VAL;
  motif.radius = 0;
  for (std::size_t k = 0; k < correlation.size(); ++k) {
    Occurrence& one = motif.occurrences[k];
    if (!whole(search, one)) continue;
    one.distance = correlation_distance(correlation[k]);
    if (one.distance <= motif.distance) motif.exemplar = one.start;
    motif.distance = std::min(motif.distance, one.distance);
    motif.radius = std::max(motif.radius, one.distance);
  }
  for (Occurrence& one : motif.occurrences) {
    if (whole(search, one)) continue;
    one = within_take(search, one);
    one.distance = motif.radius;
  }
}

}  // namespace

void refine_motifs(MotifSearch& search, const std::vector<FrameSpan>& active, std::vector<Motif>& motifs) {
  if (search.options.window == 0) {
    for (Motif& motif : motifs) {
      while (halve(search, motif)) {
      }
      grow_window(search, motif);
    }
  }
  share_out(search, motifs);
  gather_performances(search, active, motifs);
  while (search.options.window == 0 && join_parts(search, motifs)) gather_performances(search, active, motifs);
  for (Motif& motif : motifs) measure(search, motif);
}

}  // namespace motex
