// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/profile_kernel.h"

#include <cstddef>
#include <cstring>
#include <vector>

namespace motex {
namespace {

constexpr int kLanes = 4;
constexpr int kVectors = kDiagonals / kLanes;
// One register with AVX2, two without. Wider ones gain nothing: g++ 12 takes comparisons of 512 bits apart.
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));
using Mask = long long __attribute__((vector_size(kLanes * sizeof(long long))));

#define MOTEX_INLINE inline __attribute__((always_inline))

MOTEX_INLINE void load(Lanes& lanes, const double* from) { std::memcpy(&lanes, from, sizeof lanes); }

MOTEX_INLINE bool any(const Mask& mask) { return ((mask[0] | mask[1]) | (mask[2] | mask[3])) != 0; }

/// Covariances of window `row` with row + diagonal … + kDiagonals − 1, times m.
MOTEX_INLINE void begin(const ProfileRows& rows, int s, int row, int diagonal, Lanes* covariance) {
  const double* x = rows.values + static_cast<std::ptrdiff_t>(s) * rows.value_stride + row;
  const double* mean = rows.mean + static_cast<std::ptrdiff_t>(s) * rows.stride + row;
  Lanes mean_of_other[kVectors];
  for (int v = 0; v < kVectors; ++v) {
    load(mean_of_other[v], mean + diagonal + v * kLanes);
    covariance[v] = Lanes{};
  }
  for (int t = 0; t < rows.window; ++t)
    for (int v = 0; v < kVectors; ++v) {
      Lanes y;
      load(y, x + t + diagonal + v * kLanes);
      covariance[v] += (x[t] - mean[0]) * (y - mean_of_other[v]);
    }
}

/// Rare: some of a row's correlations beat what is known.
__attribute__((noinline)) void keep(const ProfileRows& rows, int row, int diagonal, const double* correlations) {
  for (int k = 0; k < kDiagonals; ++k) {
    const double correlation = correlations[k];
    const int other = row + diagonal + k;
    if (correlation > rows.correlation[other]) {
      rows.correlation[other] = correlation;
      rows.nearest[other] = row;
    }
    if (correlation > rows.correlation[row]) {
      rows.correlation[row] = correlation;
      rows.nearest[row] = other;
    }
  }
}

MOTEX_INLINE void walk_one_signal(const ProfileRows& rows, int diagonal, int row, int end) {
  Lanes covariance[kVectors];
  begin(rows, 0, row, diagonal, covariance);
  for (int i = row; i < end; ++i) {
    const std::ptrdiff_t j = static_cast<std::ptrdiff_t>(i) + diagonal;
    const double f = rows.f[i], g = rows.g[i], norm = rows.norm[i], best = rows.correlation[i];
    Lanes correlation[kVectors];
    Mask beats{};
    for (int v = 0; v < kVectors; ++v) {
      Lanes others;
      if (i > row) {
        Lanes g_other;
        load(others, rows.f + j + v * kLanes);
        load(g_other, rows.g + j + v * kLanes);
        covariance[v] += f * g_other + others * g;
      }
      load(others, rows.norm + j + v * kLanes);
      correlation[v] = covariance[v] * (others * norm);
      load(others, rows.correlation + j + v * kLanes);
      beats |= (correlation[v] > others) | (correlation[v] > best);
    }
    if (any(beats)) {
      double copy[kDiagonals];
      std::memcpy(copy, correlation, sizeof copy);
      keep(rows, i, diagonal, copy);
    }
  }
}

MOTEX_INLINE void walk_signals(const ProfileRows& rows, int diagonal, int row, int end) {
  std::vector<double> memory(static_cast<std::size_t>(rows.num_signals * kDiagonals));
  for (int s = 0; s < rows.num_signals; ++s) {
    Lanes covariance[kVectors];
    begin(rows, s, row, diagonal, covariance);
    std::memcpy(memory.data() + static_cast<std::ptrdiff_t>(s) * kDiagonals, covariance, sizeof covariance);
  }
  for (int i = row; i < end; ++i) {
    const std::ptrdiff_t j = static_cast<std::ptrdiff_t>(i) + diagonal;
    Lanes correlation[kVectors]{};
    for (int s = 0; s < rows.num_signals; ++s) {
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(s) * rows.stride;
      const double f = rows.f[at + i], g = rows.g[at + i], norm = rows.norm[at + i];
      double* stored = memory.data() + static_cast<std::ptrdiff_t>(s) * kDiagonals;
      for (int v = 0; v < kVectors; ++v) {
        Lanes covariance, others;
        load(covariance, stored + v * kLanes);
        if (i > row) {
          Lanes g_other;
          load(others, rows.f + at + j + v * kLanes);
          load(g_other, rows.g + at + j + v * kLanes);
          covariance += f * g_other + others * g;
          std::memcpy(stored + v * kLanes, &covariance, sizeof covariance);
        }
        load(others, rows.norm + at + j + v * kLanes);
        correlation[v] += covariance * (others * norm);
      }
    }
    const double best = rows.correlation[i];
    Mask beats{};
    for (int v = 0; v < kVectors; ++v) {
      Lanes others;
      load(others, rows.correlation + j + v * kLanes);
      beats |= (correlation[v] > others) | (correlation[v] > best);
    }
    if (any(beats)) {
      double copy[kDiagonals];
      std::memcpy(copy, correlation, sizeof copy);
      keep(rows, i, diagonal, copy);
    }
  }
}

MOTEX_INLINE void walk(const ProfileRows& rows, int diagonal, int row, int end) {
  rows.num_signals == 1 ? walk_one_signal(rows, diagonal, row, end) : walk_signals(rows, diagonal, row, end);
}

using Walk = void (*)(const ProfileRows& rows, int diagonal, int row, int end);

void walk_anywhere(const ProfileRows& rows, int diagonal, int row, int end) { walk(rows, diagonal, row, end); }

#if defined(__x86_64__)
__attribute__((target("avx2"))) void walk_avx2(const ProfileRows& rows, int diagonal, int row, int end) {
  walk(rows, diagonal, row, end);
}

Walk fastest_walk() { return __builtin_cpu_supports("avx2") ? walk_avx2 : walk_anywhere; }
#else
Walk fastest_walk() { return walk_anywhere; }
#endif

}  // namespace

void walk_diagonals(const ProfileRows& rows, int diagonal, int row, int end) {
  static const Walk kWalk = fastest_walk();
  kWalk(rows, diagonal, row, end);
}

}  // namespace motex
