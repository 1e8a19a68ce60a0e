// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/profile_kernel.h"

#include <cstddef>
#include <cstring>

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

/// Covariances of window `row` with row + diagonal … + kDiagonals − 1, times m, summed over signals.
MOTEX_INLINE void begin(const ProfileRows& rows, int num_signals, int row, int diagonal, Lanes* covariance) {
  for (int v = 0; v < kVectors; ++v) covariance[v] = Lanes{};
  for (int s = 0; s < num_signals; ++s) {
    const double* x = rows.values + static_cast<std::ptrdiff_t>(s) * rows.value_stride + row;
    const double* mean = rows.mean + static_cast<std::ptrdiff_t>(s) * rows.stride + row;
    Lanes mean_of_other[kVectors];
    for (int v = 0; v < kVectors; ++v) load(mean_of_other[v], mean + diagonal + v * kLanes);
    for (int t = 0; t < rows.window; ++t)
      for (int v = 0; v < kVectors; ++v) {
        Lanes y;
        load(y, x + t + diagonal + v * kLanes);
        covariance[v] += (x[t] - mean[0]) * (y - mean_of_other[v]);
      }
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

MOTEX_INLINE void walk_signals(const ProfileRows& rows, int num_signals, int diagonal, int row, int end) {
  Lanes covariance[kVectors];
  begin(rows, num_signals, row, diagonal, covariance);
  for (int i = row; i < end; ++i) {
    const std::ptrdiff_t j = static_cast<std::ptrdiff_t>(i) + diagonal;
    for (int s = 0; i > row && s < num_signals; ++s) {
      const double* all_f = rows.f + static_cast<std::ptrdiff_t>(s) * rows.stride;
      const double* all_g = rows.g + static_cast<std::ptrdiff_t>(s) * rows.stride;
      const double f = all_f[i], g = all_g[i];
      for (int v = 0; v < kVectors; ++v) {
        Lanes f_other, g_other;
        load(f_other, all_f + j + v * kLanes);
        load(g_other, all_g + j + v * kLanes);
        covariance[v] += f * g_other + f_other * g;
      }
    }
    const double norm = rows.norm[i], best = rows.correlation[i];
    Lanes correlation[kVectors];
    Mask beats{};
    for (int v = 0; v < kVectors; ++v) {
      Lanes others;
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

MOTEX_INLINE void walk(const ProfileRows& rows, int diagonal, int row, int end) {
  if (rows.num_signals == 1)
    walk_signals(rows, 1, diagonal, row, end);  // known to the compiler: no loop over signals
  else
    walk_signals(rows, rows.num_signals, diagonal, row, end);
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
