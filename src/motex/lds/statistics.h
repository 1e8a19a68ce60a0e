// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/core/matrix.h"

namespace motex {

/// Sufficient statistics of a second-order linear dynamic system: M = Σ_t u_t u_tᵀ with u_t = [x_t; x_{t−1}; x_{t−2};
/// 1]. They add over segments, so any grouping of segments can be fitted without touching frames again.
struct LdsStatistics {
  Matrix moments;  ///< (3d + 1) × (3d + 1), symmetric

  LdsStatistics() = default;
  explicit LdsStatistics(Index state_size) : moments(Matrix::Zero(3 * state_size + 1, 3 * state_size + 1)) {}

  Index state_size() const { return (moments.rows() - 1) / 3; }
  /// Number of frames x_t counted.
  double count() const { return moments(moments.rows() - 1, moments.cols() - 1); }
  /// Adds frames t = first … first + length − 1 of a series (rows = frames); rows first − 2 and first − 1 must exist.
  void add(const FrameMatrix& states, Index first, Index length);
  LdsStatistics& operator+=(const LdsStatistics& other);
};

/// Mean and scatter of u_t without its constant 1.
struct CentredMoments {
  double count = 0;
  Vector mean;     ///< 3d
  Matrix scatter;  ///< 3d × 3d: Σ (u − mean)(u − mean)ᵀ
};
CentredMoments centred(const LdsStatistics& statistics);

}  // namespace motex
