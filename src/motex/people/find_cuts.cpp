// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/find_cuts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/parallel.h"
#include "motex/core/quantile.h"
#include "motex/core/wide.h"
#include "motex/people/cut_smoothness.h"

namespace motex {
namespace {

constexpr int kBlock = 16;  // frames each way of which one cut is kept
constexpr int kTileFrames = kMaskTileFrames;
constexpr int kTileBlocks = kTileFrames / kBlock;
constexpr int kMaxMaskSum = 2 * kMaskBits / 8;  // of two frames
constexpr double kSmoothnessShare = 0.5;        // a smoothness of 1 against the largest distance of masks
constexpr double kNaturalTimes = 1.5, kLeastDifference = 20;
constexpr int kMaxMoves = 6;

/// Frames f < g that are alike, and so are those after them: film can go from f to g + 1, or from g to f + 1.
struct Candidate {
  int f = -1, g = -1;
  bool forward = true;
  double score = std::numeric_limits<double>::infinity();
  int from() const { return forward ? f : g; }
  int to() const { return (forward ? g : f) + 1; }
};

/// What a tile of the search keeps while its bands pass.
struct TileSearch {
  int first_row = -1, first_column = 0;
  std::vector<Candidate> best;          // [16 × 16 block of the tile][each way]
  std::vector<std::uint16_t> last_row;  // the last row of the band before
  int last_row_column = 0;
};

MOTEX_WIDE void add_up(const std::uint16_t* a, const std::uint16_t* b, std::size_t count, std::uint16_t* sum) {
  for (std::size_t i = 0; i < count; ++i) sum[i] = static_cast<std::uint16_t>(a[i] + b[i]);
}

class CutSearch {
 public:
  CutSearch(const PeopleTexture& texture, const ComparableFrames& frames, const FindCutsOptions& options)
      : texture_(texture),
        pictures_(frames.pictures),
        options_(options),
        take_of_(take_of_frames(texture)),
        scales_(second_difference_scales(texture)),
        min_jump_(std::max(2, static_cast<int>(std::lround(options.min_jump_secs * texture.frames_per_sec)))) {
    std::vector<double> natural;
    for (int t = 0; t + 1 < texture.num_frames(); ++t)
      if (goes_on(t)) natural.push_back(pictures_.difference(t, t + 1));
    natural_difference_ = natural.empty() ? 1 : std::max(quantile(std::move(natural), 0.95), 0.5);
    max_difference_ = options.max_difference > 0 ? options.max_difference
                                                 : std::max(kNaturalTimes * natural_difference_, kLeastDifference);
  }

  double natural_difference() const { return natural_difference_; }
  double max_difference() const { return max_difference_; }

  std::vector<Candidate> candidates(const MaskSet& masks, int jobs) const {
    std::vector<TileSearch> tiles(static_cast<std::size_t>(masks.num_tiles()));
    masks.visit_bands([&](int tile, const MaskBand& band) { visit(tiles[static_cast<std::size_t>(tile)], band); }, true,
                      jobs);
    std::vector<Candidate> found;
    for (const TileSearch& tile : tiles)
      for (const Candidate& candidate : tile.best)
        if (candidate.f >= 0) found.push_back(candidate);
    return found;
  }

  /// The best cut at or next to a candidate; from < 0 when none passes the limits.
  Cut refined(Candidate candidate) const {
    Cut best = measured(candidate);
    if (best.difference > 2 * max_difference_) return {-1, -1};
    for (int move = 0; move < kMaxMoves; ++move) {
      const Candidate centre = candidate;
      bool moved = false;
      for (const auto& [df, dg] : {std::pair{-1, -1}, {0, -1}, {-1, 0}, {1, 0}, {0, 1}, {1, 1}}) {
        Candidate beside = centre;
        beside.f += df, beside.g += dg;
        if (!is_allowed(beside)) continue;
        const Cut cut = measured(beside);
        if (cost_of(cut) < cost_of(best)) best = cut, candidate = beside, moved = true;
      }
      if (!moved) break;
    }
    const bool good = best.difference <= max_difference_ && best.smoothness <= options_.max_smoothness;
    return good ? best : Cut{-1, -1};
  }

  double cost_of(const Cut& cut) const { return std::hypot(cut.difference / natural_difference_, cut.smoothness); }

 private:
  bool goes_on(int t) const {
    const auto i = static_cast<std::size_t>(t);
    return t >= 0 && i + 1 < take_of_.size() && take_of_[i] == take_of_[i + 1] && !texture_.silhouettes[i].empty() &&
           !texture_.silhouettes[i + 1].empty();
  }

  bool is_allowed(const Candidate& candidate) const {
    const int f = candidate.f, g = candidate.g;
    if (!goes_on(f) || !goes_on(g)) return false;
    const int take_f = take_of_[static_cast<std::size_t>(f)], take_g = take_of_[static_cast<std::size_t>(g)];
    if (take_f == take_g) return std::abs(g - f) >= min_jump_;
    return texture_.takes[static_cast<std::size_t>(take_f)].person ==
           texture_.takes[static_cast<std::size_t>(take_g)].person;
  }

  Cut measured(const Candidate& candidate) const {
    Cut cut{candidate.from(), candidate.to()};
    cut.difference = cut_difference(pictures_, cut.from, cut.to);
    cut.smoothness = cut_smoothness(texture_, scales_, cut.from, cut.to).largest();
    return cut;
  }

  void visit(TileSearch& tile, const MaskBand& band) const {
    if (tile.first_row < 0) {
      tile.first_row = band.first_row, tile.first_column = band.first_column;
      tile.best.resize(std::size_t{2} * kTileBlocks * kTileBlocks);
    }
    const int rows = std::min(8, texture_.num_frames() - band.first_row);
    for (int r = -1; r + 1 < rows; ++r) {
      const std::uint16_t* next = band.distances + static_cast<std::ptrdiff_t>(r + 1) * band.stride;
      const std::uint16_t* now = r >= 0 ? next - band.stride : tile.last_row.data();
      const int now_column = r >= 0 ? band.first_column : tile.last_row_column;
      const int f = band.first_row + r;
      if (f < tile.first_row || f >= tile.first_row + kTileFrames || !goes_on(f)) continue;
      scan(tile, f, {now, now_column}, {next, band.first_column}, band.first_column + band.num_columns);
    }
    const std::uint16_t* last = band.distances + static_cast<std::ptrdiff_t>(7) * band.stride;
    tile.last_row.assign(last, last + band.num_columns);
    tile.last_row_column = band.first_column;
  }

  struct Row {
    const std::uint16_t* distances;
    int first_column;
  };

  /// Row f against all g of the tile.
  void scan(TileSearch& tile, int f, Row now, Row next, int end_column) const {
    const int first = std::max({now.first_column, next.first_column - 1, tile.first_column, f + 1});
    const int end = std::min(end_column - 1, tile.first_column + kTileFrames);
    if (end <= first) return;
    std::array<std::uint16_t, kTileFrames> sums{};
    add_up(now.distances + (first - now.first_column), next.distances + (first + 1 - next.first_column),
           static_cast<std::size_t>(end - first), sums.data());
    for (int g = first; g < end; ++g) {
      const int sum = sums[static_cast<std::size_t>(g - first)];
      if (sum > kMaxMaskSum || !is_allowed({f, g})) continue;
      const std::size_t block = static_cast<std::size_t>((f - tile.first_row) / kBlock) * kTileBlocks +
                                static_cast<std::size_t>((g - tile.first_column) / kBlock);
      const double like = static_cast<double>(sum) / kMaxMaskSum;
      for (const bool forward : {true, false}) {
        Candidate& best = tile.best[2 * block + (forward ? 0U : 1U)];
        if (like >= best.score) continue;
        Candidate candidate{f, g, forward};
        const double smoothness = cut_smoothness(texture_, scales_, candidate.from(), candidate.to()).largest();
        candidate.score = like + kSmoothnessShare * smoothness;
        if (smoothness <= 2 * options_.max_smoothness && candidate.score < best.score) best = candidate;
      }
    }
  }

  const PeopleTexture& texture_;
  const SilhouettePictures& pictures_;
  const FindCutsOptions& options_;
  std::vector<int> take_of_;
  SecondDifferenceScales scales_;
  int min_jump_;
  double natural_difference_ = 1, max_difference_ = 0;
};

void check_frames(const PeopleTexture& texture, const ComparableFrames& frames) {
  const auto num_frames = static_cast<std::size_t>(texture.num_frames());
  if (frames.masks.size() != num_frames || frames.pictures.num_frames() != texture.num_frames())
    throw InvalidInput("there are " + std::to_string(num_frames) + " silhouettes, but pictures of " +
                       std::to_string(frames.masks.size()) + " frames");
  if (!(texture.frames_per_sec > 0)) throw InvalidInput("a people texture needs a frame rate above 0");
}

}  // namespace

FindCutsReport find_cuts(const PeopleTexture& texture, const ComparableFrames& frames, const FindCutsOptions& options,
                         const JobContext& job) {
  check_options(options);
  check_frames(texture, frames);
  const CutSearch search(texture, frames, options);
  FindCutsReport report;
  report.max_difference = search.max_difference();
  report.cuts.natural_difference = search.natural_difference();
  report.num_compared = std::int64_t{texture.num_frames()} * (texture.num_frames() - 1) / 2;
  job.progress("finding cuts", 0);
  const std::vector<Candidate> candidates = search.candidates(MaskSet(frames.masks), job.jobs);
  report.num_candidates = static_cast<std::int64_t>(candidates.size());
  job.check_cancelled();
  job.progress("finding cuts", 0.5);
  std::vector<Cut> cuts(candidates.size());
  constexpr std::size_t kTask = 256;
  parallel_for(job.jobs, static_cast<int>((candidates.size() + kTask - 1) / kTask), [&](int task) {
    const std::size_t first = static_cast<std::size_t>(task) * kTask;
    for (std::size_t i = first; i < std::min(first + kTask, candidates.size()); ++i)
      cuts[i] = search.refined(candidates[i]);
  });
  const auto order = [](const Cut& a, const Cut& b) { return std::pair(a.from, a.to) < std::pair(b.from, b.to); };
  const auto same = [](const Cut& a, const Cut& b) { return a.from == b.from && a.to == b.to; };
  std::erase_if(cuts, [](const Cut& cut) { return cut.from < 0; });
  std::sort(cuts.begin(), cuts.end(), order);
  cuts.erase(std::unique(cuts.begin(), cuts.end(), same), cuts.end());
  report.cuts.cuts = std::move(cuts);
  job.progress("finding cuts", 1);
  return report;
}

double cut_difference(const SilhouettePictures& pictures, int from, int to) {
  const double last = pictures.difference(from, to - 1), first = pictures.difference(from + 1, to);
  return std::sqrt((last * last + first * first) / 2);
}

}  // namespace motex
