// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

namespace motex {

/// Diagonals of the matrix of all pairs of windows that are walked side by side.
inline constexpr int kDiagonals = 32;

/// Arrays of matrix_profile(): f, g and mean of signal s begin at s · stride, values at s · value_stride; norm and
/// correlation are one a window. All have kDiagonals entries after the last window, where norm is 0 and correlation
/// infinite.
struct ProfileRows {
  const double *f, *g, *norm, *mean, *values;
  int stride, value_stride, num_signals, window;
  double* correlation;  ///< best of every window so far
  int* nearest;
};

/// Compares windows i and i + d for i = row … end − 1 and d = diagonal … diagonal + kDiagonals − 1 and keeps what beats
/// the best so far. The machine's widest vectors are used; the bytes are the same with any.
void walk_diagonals(const ProfileRows& rows, int diagonal, int row, int end);

}  // namespace motex
