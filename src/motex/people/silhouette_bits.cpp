// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/silhouette_bits.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "motex/core/error.h"
#include "motex/core/parallel.h"
#include "motex/core/wide.h"

namespace motex {
namespace {

constexpr int kTileBlocks = kMaskTileFrames / 8;

/// Pixels of a sprite's row or column that the cells look at: two a cell, −1 outside.
std::vector<int> sample_places(double first, double cell, int num_cells, int sprite_first, int size) {
  std::vector<int> places;
  for (int k = 0; k < 2 * num_cells; ++k) {
    const int pixel = static_cast<int>(std::floor(first + cell * (0.25 + 0.5 * k) + 0.5)) - sprite_first;
    places.push_back(pixel >= 0 && pixel < size ? pixel : -1);
  }
  return places;
}

int alpha_at(const Sprite& sprite, int x, int y) { return x < 0 || y < 0 ? 0 : sprite.at(x, y)[3]; }

}  // namespace

MaskBits mask_bits(const Sprite& sprite, const Silhouette& silhouette, MaskAlignment alignment, double cell_width,
                   double cell_height) {
  MaskBits bits{};
  if (silhouette.empty() || sprite.empty()) return bits;
  const BoundingBox& box = silhouette.box;
  double left = box.left - 0.5, top = box.top - 0.5;
  if (alignment == MaskAlignment::kBox) {
    cell_width = static_cast<double>(box.width()) / kMaskColumns;
    cell_height = static_cast<double>(box.height()) / kMaskRows;
  } else if (!(cell_width > 0 && cell_height > 0)) {
    throw InvalidInput("a mask that is pinned to a corner needs cells of a size above 0");
  }
  if (alignment == MaskAlignment::kRightTop || alignment == MaskAlignment::kRightBottom)
    left = box.right + 0.5 - kMaskColumns * cell_width;
  if (alignment == MaskAlignment::kLeftBottom || alignment == MaskAlignment::kRightBottom)
    top = box.bottom + 0.5 - kMaskRows * cell_height;
  const std::vector<int> xs = sample_places(left, cell_width, kMaskColumns, sprite.left, sprite.width);
  const std::vector<int> ys = sample_places(top, cell_height, kMaskRows, sprite.top, sprite.height);
  for (std::size_t row = 0; row < kMaskRows; ++row)
    for (std::size_t column = 0; column < kMaskColumns; ++column) {
      int sum = 0;
      for (const int y : {ys[2 * row], ys[2 * row + 1]})
        sum += alpha_at(sprite, xs[2 * column], y) + alpha_at(sprite, xs[2 * column + 1], y);
      const std::size_t bit = row * kMaskColumns + column;
      if (sum >= 2 * 255) bits[bit / 64] |= std::uint64_t{1} << (bit % 64);
    }
  return bits;
}

std::array<double, 2> mask_cell_size(std::span<const Silhouette> silhouettes) {
  int width = kMaskColumns, height = kMaskRows;
  for (const Silhouette& silhouette : silhouettes) {
    width = std::max(width, silhouette.box.width());
    height = std::max(height, silhouette.box.height());
  }
  return {static_cast<double>(width) / kMaskColumns, static_cast<double>(height) / kMaskRows};
}

int mask_distance(const MaskBits& a, const MaskBits& b) {
  int sum = 0;
  for (std::size_t w = 0; w < a.size(); ++w) sum += std::popcount(a[w] ^ b[w]);
  return sum;
}

MaskSet::MaskSet(std::span<const MaskBits> masks)
    : MaskSet(std::vector<std::vector<MaskBits>>(1, std::vector<MaskBits>(masks.begin(), masks.end()))) {}

MaskSet::MaskSet(const std::vector<std::vector<MaskBits>>& alignments) {
  if (alignments.empty()) throw InvalidInput("masks are to be compared in one alignment at least");
  num_frames_ = static_cast<int>(alignments[0].size());
  for (const std::vector<MaskBits>& masks : alignments) {
    if (masks.size() != alignments[0].size()) throw InvalidInput("each alignment of masks needs one a frame");
    std::vector<HammingBlock>& blocks = alignments_.emplace_back((masks.size() + 7) / 8);
    for (std::size_t f = 0; f < masks.size(); ++f)
      for (std::size_t w = 0; w < kMaskWords; ++w) blocks[f / 8].words[w][f % 8] = masks[f][w];
  }
}

int MaskSet::distance(int a, int b) const {
  const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
  int least = kMaskBits + 1;
  for (const std::vector<HammingBlock>& blocks : alignments_) {
    int sum = 0;
    for (std::size_t w = 0; w < kMaskWords; ++w)
      sum += std::popcount(blocks[i / 8].words[w][i % 8] ^ blocks[j / 8].words[w][j % 8]);
    least = std::min(least, sum);
  }
  return least;
}

int MaskSet::num_tiles() const {
  const int side = (num_frames_ + kMaskTileFrames - 1) / kMaskTileFrames;
  return side * (side + 1) / 2;
}

void MaskSet::visit_bands(const std::function<void(int tile, const MaskBand& band)>& visit, bool overlap,
                          int jobs) const {
  if (num_frames_ == 0) return;
  const int num_blocks = static_cast<int>(alignments_[0].size());
  std::vector<std::array<int, 2>> tiles;
  for (int r = 0; r < num_blocks; r += kTileBlocks)
    for (int c = r; c < num_blocks; c += kTileBlocks) tiles.push_back({r, c});
  const HammingKernels::Count count = HammingKernels::best();
  parallel_for(jobs, static_cast<int>(tiles.size()), [&](int tile) {
    const auto [first_row, first_column] = tiles[static_cast<std::size_t>(tile)];
    const int more = kTileBlocks + (overlap ? 1 : 0);
    const int end_row = std::min(first_row + more, num_blocks), end_column = std::min(first_column + more, num_blocks);
    std::vector<std::uint16_t> distances(std::size_t{64} * static_cast<std::size_t>(more)), other(distances.size());
    for (int row = first_row; row < end_row; ++row) {
      const int column = std::max(first_column, std::min(row, end_column));
      const int num = end_column - column, stride = 8 * more;
      if (num == 0) continue;
      for (std::size_t a = 0; a < alignments_.size(); ++a) {
        const HammingBlock* blocks = alignments_[a].data();
        count(blocks + row, blocks + column, num, (a == 0 ? distances : other).data(), stride);
        if (a > 0)
          for (std::size_t i = 0; i < other.size(); ++i) distances[i] = std::min(distances[i], other[i]);
      }
      visit(tile, {8 * row, 8 * column, std::min(8 * num, num_frames_ - 8 * column), stride, distances.data()});
    }
  });
}

namespace {

/// Least distance so far and where, of the columns of one tile.
struct ColumnLeast {
  std::vector<std::uint16_t> distance, row;
};

/// Where a row is nearer to a column than all before it.
MOTEX_WIDE void take_least(const std::uint16_t* distances, std::size_t count, std::uint16_t row, std::uint16_t* least,
                           std::uint16_t* least_row) {
  for (std::size_t i = 0; i < count; ++i) {
    const bool nearer = distances[i] < least[i];
    least_row[i] = nearer ? row : least_row[i];
    least[i] = nearer ? distances[i] : least[i];
  }
}

MOTEX_WIDE std::uint16_t least_of(const std::uint16_t* distances, std::size_t count) {
  std::uint16_t least = 0xffff;
  for (std::size_t i = 0; i < count; ++i) least = std::min(least, distances[i]);
  return least;
}

void take_nearer(NearestMask& nearest, int frame, int distance) {
  if (distance < nearest.distance || (distance == nearest.distance && frame < nearest.frame))
    nearest = {frame, distance};
}

}  // namespace

std::vector<NearestMask> MaskSet::nearest(int apart, int jobs) const {
  apart = std::max(apart, 1);
  struct Tile {
    int first_row = -1, first_column = 0;
    std::vector<NearestMask> rows;
    ColumnLeast columns;
  };
  std::vector<Tile> tiles(static_cast<std::size_t>(num_tiles()));
  visit_bands(
      [&](int t, const MaskBand& band) {
        Tile& tile = tiles[static_cast<std::size_t>(t)];
        if (tile.first_row < 0) {
          tile.first_row = band.first_row, tile.first_column = band.first_column;
          tile.columns = {std::vector<std::uint16_t>(kMaskTileFrames, 0xffff),
                          std::vector<std::uint16_t>(kMaskTileFrames)};
        }
        for (int r = 0; r < std::min(8, num_frames_ - band.first_row); ++r) {
          const int row = band.first_row + r, skip = std::max(0, row + apart - band.first_column);
          NearestMask& nearest = tile.rows.emplace_back();
          if (skip >= band.num_columns) continue;
          const std::uint16_t* distances = band.distances + static_cast<std::ptrdiff_t>(r) * band.stride + skip;
          const auto num = static_cast<std::size_t>(band.num_columns - skip);
          const auto column = static_cast<std::size_t>(band.first_column + skip - tile.first_column);
          const std::uint16_t least = least_of(distances, num);
          nearest = {
              band.first_column + skip + static_cast<int>(std::find(distances, distances + num, least) - distances),
              least};
          take_least(distances, num, static_cast<std::uint16_t>(row - tile.first_row), &tile.columns.distance[column],
                     &tile.columns.row[column]);
        }
      },
      false, jobs);
  std::vector<NearestMask> nearest(static_cast<std::size_t>(num_frames_));
  for (const Tile& tile : tiles) {
    for (std::size_t r = 0; r < tile.rows.size(); ++r)
      if (tile.rows[r].frame >= 0)
        take_nearer(nearest[static_cast<std::size_t>(tile.first_row) + r], tile.rows[r].frame, tile.rows[r].distance);
    for (std::size_t c = 0; c < tile.columns.distance.size(); ++c)
      if (tile.columns.distance[c] != 0xffff)
        take_nearer(nearest[static_cast<std::size_t>(tile.first_column) + c], tile.first_row + tile.columns.row[c],
                    tile.columns.distance[c]);
  }
  return nearest;
}

std::vector<MaskPair> MaskSet::pairs_within(int limit, int apart, int jobs) const {
  apart = std::max(apart, 1);
  std::vector<std::vector<MaskPair>> by_tile(static_cast<std::size_t>(num_tiles()));
  visit_bands(
      [&](int tile, const MaskBand& band) {
        std::vector<MaskPair>& pairs = by_tile[static_cast<std::size_t>(tile)];
        for (int r = 0; r < std::min(8, num_frames_ - band.first_row); ++r) {
          const int row = band.first_row + r;
          const std::uint16_t* distances = band.distances + static_cast<std::ptrdiff_t>(r) * band.stride;
          for (int c = std::max(0, row + apart - band.first_column); c < band.num_columns; ++c)
            if (distances[c] <= limit) pairs.push_back({row, band.first_column + c, distances[c]});
        }
      },
      false, jobs);
  std::vector<MaskPair> all;
  for (const std::vector<MaskPair>& pairs : by_tile) all.insert(all.end(), pairs.begin(), pairs.end());
  std::sort(all.begin(), all.end(),
            [](const MaskPair& x, const MaskPair& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });
  return all;
}

const char* mask_instructions() { return HammingKernels::name(); }

}  // namespace motex
