// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "motex/core/hamming_blocks.h"
#include "motex/core/job.h"
#include "motex/people/silhouette.h"
#include "motex/people/sprite.h"

namespace motex {

/// A silhouette as 2,048 bits: 64 rows of 32 cells, row by row from the top left, two rows a word; a cell is set where
/// at least half of it is covered. The fast filter before pictures are compared; [PT04] section 3.1 compares pictures.
constexpr int kMaskColumns = 32, kMaskRows = 64, kMaskWords = 32, kMaskBits = 2048;
constexpr int kMaskTileFrames = 512;  ///< 128 KiB of masks: they stay in the second-level cache
using MaskBits = std::array<std::uint64_t, kMaskWords>;

/// How the cells lie on a frame. kBox: the bounding box is stretched to the grid, so that place, size and aspect are
/// gone. The others keep the scale and pin the corner of the box whose two edges stand still: what grows or shrinks
/// does so at the opposite edges only.
enum class MaskAlignment { kBox, kLeftTop, kRightTop, kLeftBottom, kRightBottom };

/// The mask of a frame. cell_width, cell_height: pixels, of the pinned alignments only; one size for all frames that
/// are to be compared (mask_cell_size). Nothing is set when the silhouette is empty.
MaskBits mask_bits(const Sprite& sprite, const Silhouette& silhouette, MaskAlignment alignment = MaskAlignment::kBox,
                   double cell_width = 0, double cell_height = 0);

/// Cells of which 32 × 64 hold the largest box: width and height in pixels, at least 1.
std::array<double, 2> mask_cell_size(std::span<const Silhouette> silhouettes);

/// Number of cells in which two masks differ.
int mask_distance(const MaskBits& a, const MaskBits& b);

/// Distances of eight frames first_row … first_row + 7 to frames first_column … first_column + num_columns − 1; row r
/// begins at distances[r · stride]. Rows past the last frame are there and mean nothing.
struct MaskBand {
  int first_row = 0;
  int first_column = 0;
  int num_columns = 0;
  int stride = 0;
  const std::uint16_t* distances = nullptr;
};

/// The frame most like another one.
struct NearestMask {
  int frame = -1;
  int distance = kMaskBits + 1;
};

/// Two frames and in how many cells they differ.
struct MaskPair {
  int a = 0, b = 0;  ///< a < b
  int distance = 0;
};

/// Masks of many frames, kept word by word for eight frames at a time, so that eight pairs are counted in one vector
/// register and nothing is added across lanes. With several alignments the distance of two frames is the least over
/// them. All distances of 9,000 frames take some 0.1 s of CPU with AVX-512 VPOPCNTDQ and 0.3 s with AVX2, as often as
/// there are alignments; the numbers are the same everywhere. Nothing quadratic is kept.
class MaskSet {
 public:
  MaskSet() = default;
  explicit MaskSet(std::span<const MaskBits> masks);
  /// Throws InvalidInput unless there is an alignment and each has a mask a frame.
  explicit MaskSet(const std::vector<std::vector<MaskBits>>& alignments);

  int num_frames() const { return num_frames_; }
  int distance(int a, int b) const;

  /// Every pair (row, column) with column ≥ row is in one band, and some with column < row. Tiles are 512 × 512 frames;
  /// a tile's bands come in rising order from one thread, tiles from several. With `overlap` a tile has one more band
  /// of eight rows and eight more columns, which its neighbours have too.
  void visit_bands(const std::function<void(int tile, const MaskBand& band)>& visit, bool overlap = false,
                   int jobs = 0) const;
  int num_tiles() const;

  /// By frame, the nearest of the others that are at least `apart` frames away; of equal ones the earliest.
  std::vector<NearestMask> nearest(int apart = 1, int jobs = 0) const;
  /// All pairs at least `apart` frames apart and at most `limit` cells different, by a, then b.
  std::vector<MaskPair> pairs_within(int limit, int apart = 1, int jobs = 0) const;

 private:
  int num_frames_ = 0;
  std::vector<std::vector<HammingBlock>> alignments_;
};

/// Which instructions count the bits here: "AVX-512", "AVX2" or "portable".
const char* mask_instructions();

}  // namespace motex
