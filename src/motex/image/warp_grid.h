// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace motex {

/// Where each pixel of a warped picture comes from: pixel p from p + u(p). u is held at grid points `spacing` pixels
/// apart, the first at (left, top), and is bilinear between them; beyond the grid its edge goes on.
struct WarpGrid {
  int left = 0, top = 0;
  int spacing = 8;            ///< pixels, ≥ 1
  int columns = 0, rows = 0;  ///< ≥ 2
  std::vector<float> x, y;    ///< u at the grid points, pixels, row by row

  WarpGrid() = default;
  /// u = 0, grid points enough for that rectangle of pixels.
  WarpGrid(int left_px, int top_px, int width, int height, int spacing_px);

  struct Displacement {
    double x = 0, y = 0;
  };
  Displacement at(double px, double py) const;
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
};

}  // namespace motex
