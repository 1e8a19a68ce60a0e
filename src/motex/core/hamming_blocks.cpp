// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/core/hamming_blocks.h"

#include <bit>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace motex {

void HammingKernels::portable(const HammingBlock* row, const HammingBlock* columns, int num_columns,
                              std::uint16_t* distances, int stride) {
  for (int b = 0; b < num_columns; ++b)
    for (std::size_t r = 0; r < 8; ++r) {
      std::array<int, 8> sums{};
      for (std::size_t w = 0; w < HammingBlock::kWords; ++w)
        for (std::size_t c = 0; c < 8; ++c) sums[c] += std::popcount(row->words[w][r] ^ columns[b].words[w][c]);
      for (std::size_t c = 0; c < 8; ++c)
        distances[r * static_cast<std::size_t>(stride) + static_cast<std::size_t>(8 * b) + c] =
            static_cast<std::uint16_t>(sums[c]);
    }
}

#if defined(__x86_64__)

// Half bytes looked up in a table; bytes hold up to 16 words before they are added up.
__attribute__((target("avx2"))) void HammingKernels::avx2(const HammingBlock* row, const HammingBlock* columns,
                                                          int num_columns, std::uint16_t* distances, int stride) {
  const __m256i table =
      _mm256_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4, 0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4);
  const __m256i low = _mm256_set1_epi8(15), zero = _mm256_setzero_si256();
  for (int b = 0; b < num_columns; ++b)
    for (std::size_t r = 0; r < 8; ++r)
      for (std::size_t half = 0; half < 2; ++half) {
        __m256i sum = zero;
        for (std::size_t first = 0; first < HammingBlock::kWords; first += 16) {
          __m256i bytes = zero;
          for (std::size_t w = first; w < first + 16; ++w) {
            const __m256i column = _mm256_load_si256(reinterpret_cast<const __m256i*>(&columns[b].words[w][4 * half]));
            const __m256i differ =
                _mm256_xor_si256(column, _mm256_set1_epi64x(static_cast<std::int64_t>(row->words[w][r])));
            const __m256i high = _mm256_and_si256(_mm256_srli_epi16(differ, 4), low);
            bytes = _mm256_add_epi8(bytes, _mm256_shuffle_epi8(table, _mm256_and_si256(differ, low)));
            bytes = _mm256_add_epi8(bytes, _mm256_shuffle_epi8(table, high));
          }
          sum = _mm256_add_epi64(sum, _mm256_sad_epu8(bytes, zero));
        }
        alignas(32) std::array<std::uint64_t, 4> lanes{};
        _mm256_store_si256(reinterpret_cast<__m256i*>(lanes.data()), sum);
        std::uint16_t* out =
            distances + r * static_cast<std::size_t>(stride) + static_cast<std::size_t>(8 * b) + 4 * half;
        for (std::size_t c = 0; c < 4; ++c) out[c] = static_cast<std::uint16_t>(lanes[c]);
      }
}

// Eight rows against eight columns: 64 distances in eight registers.
__attribute__((target("avx512f,avx512vpopcntdq"))) void HammingKernels::avx512(const HammingBlock* row,
                                                                               const HammingBlock* columns,
                                                                               int num_columns,
                                                                               std::uint16_t* distances, int stride) {
  for (int b = 0; b < num_columns; ++b) {
    __m512i sums[8];  // NOLINT(modernize-avoid-c-arrays): std::array of vectors drops their alignment attribute
    for (__m512i& sum : sums) sum = _mm512_setzero_si512();
    for (std::size_t w = 0; w < HammingBlock::kWords; ++w) {
      const __m512i column = _mm512_load_si512(columns[b].words[w].data());
      for (std::size_t r = 0; r < 8; ++r) {
        const __m512i differ = _mm512_xor_si512(column, _mm512_set1_epi64(static_cast<std::int64_t>(row->words[w][r])));
        sums[r] = _mm512_add_epi64(sums[r], _mm512_popcnt_epi64(differ));
      }
    }
    for (std::size_t r = 0; r < 8; ++r)
      _mm_storeu_si128(reinterpret_cast<__m128i*>(distances + r * static_cast<std::size_t>(stride) +
                                                  static_cast<std::size_t>(8 * b)),
                       _mm512_maskz_cvtepi64_epi16(0xff, sums[r]));
  }
}

bool HammingKernels::has_avx2() { return __builtin_cpu_supports("avx2") != 0; }
bool HammingKernels::has_avx512() {
  return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vpopcntdq") != 0;
}
HammingKernels::Count HammingKernels::best() { return has_avx512() ? avx512 : has_avx2() ? avx2 : portable; }

#else

bool HammingKernels::has_avx2() { return false; }
bool HammingKernels::has_avx512() { return false; }
HammingKernels::Count HammingKernels::best() { return portable; }

#endif

const char* HammingKernels::name() { return has_avx512() ? "AVX-512" : has_avx2() ? "AVX2" : "portable"; }

}  // namespace motex
