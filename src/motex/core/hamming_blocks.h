// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace motex {

/// Eight words of 2,048 bits, side by side, so that eight pairs are counted in one vector register.
struct alignas(64) HammingBlock {
  static constexpr std::size_t kWords = 32;
  std::array<std::array<std::uint64_t, 8>, kWords> words;  ///< [word][member]
};

/// In how many bits members of blocks differ, once for each kind of vector instructions; all count the same.
struct HammingKernels {
  /// distances[r · stride + 8 b + c] of member r of `row` to member c of columns[b].
  using Count = void (*)(const HammingBlock* row, const HammingBlock* columns, int num_columns,
                         std::uint16_t* distances, int stride);

  static void portable(const HammingBlock* row, const HammingBlock* columns, int num_columns, std::uint16_t* distances,
                       int stride);
#if defined(__x86_64__)
  static void avx2(const HammingBlock* row, const HammingBlock* columns, int num_columns, std::uint16_t* distances,
                   int stride);
  static void avx512(const HammingBlock* row, const HammingBlock* columns, int num_columns, std::uint16_t* distances,
                     int stride);
#endif
  static bool has_avx2();
  static bool has_avx512();
  /// The fastest that this machine has.
  static Count best();
  static const char* name();
};

}  // namespace motex
