// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/warp_grid.h"

#include <algorithm>

#include "motex/core/error.h"

namespace motex {

WarpGrid::WarpGrid(int left_px, int top_px, int width, int height, int spacing_px)
    : left(left_px), top(top_px), spacing(spacing_px) {
  if (width < 1 || height < 1 || spacing < 1)
    throw InvalidInput("a warp needs a rectangle with pixels in it and a grid at least 1 pixel apart");
  columns = (width + spacing - 2) / spacing + 1;
  rows = (height + spacing - 2) / spacing + 1;
  columns = std::max(columns, 2), rows = std::max(rows, 2);
  x.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  y = x;
}

WarpGrid::Displacement WarpGrid::at(double px, double py) const {
  const double gx = std::clamp((px - left) / spacing, 0.0, columns - 1.0);
  const double gy = std::clamp((py - top) / spacing, 0.0, rows - 1.0);
  const int column = std::min(static_cast<int>(gx), columns - 2), row = std::min(static_cast<int>(gy), rows - 2);
  const double fx = gx - column, fy = gy - row;
  const auto between = [&](const std::vector<float>& u) {
    const double above = u[index(column, row)] * (1 - fx) + u[index(column + 1, row)] * fx;
    const double below = u[index(column, row + 1)] * (1 - fx) + u[index(column + 1, row + 1)] * fx;
    return above * (1 - fy) + below * fy;
  };
  return {between(x), between(y)};
}

}  // namespace motex
