// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/people/silhouette_bits.h"

namespace motex {

/// The inner loop of MaskSet, once for each kind of vector instructions; all count the same.
struct MaskKernels {
  static constexpr int kTileFrames = 512;  ///< 128 KiB of masks: they stay in the second-level cache
  using Block = MaskSet::Block;
  /// distances[r · stride + 8 b + c] of frame r of `row` to frame c of columns[b].
  using Count = void (*)(const Block* row, const Block* columns, int num_columns, std::uint16_t* distances, int stride);

  static void portable(const Block* row, const Block* columns, int num_columns, std::uint16_t* distances, int stride);
#if defined(__x86_64__)
  static void avx2(const Block* row, const Block* columns, int num_columns, std::uint16_t* distances, int stride);
  static void avx512(const Block* row, const Block* columns, int num_columns, std::uint16_t* distances, int stride);
#endif
  static bool has_avx2();
  static bool has_avx512();
  static Count best();
  static const char* name();
};

}  // namespace motex
