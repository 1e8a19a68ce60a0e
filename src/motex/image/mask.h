// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "motex/image/planes.h"

namespace motex {

/// Which pixels belong to something: 0 or 1 a pixel, row by row.
struct Mask {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  ///< width · height

  Mask() = default;
  /// Throws InvalidInput unless sizes are 0 … 32768.
  Mask(int width_px, int height_px, bool fill = false);

  std::uint8_t& at(int x, int y) { return pixels[index(x, y)]; }
  bool at(int x, int y) const { return pixels[index(x, y)] != 0; }
  std::int64_t area() const;  ///< number of pixels that are in

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// Pixels whose value is at least `level`.
Mask threshold(const Plane& plane, float level);

/// Pixels that have one of the mask within `radius` pixels (Euclidean); erode: only such ones. Outside counts as out
/// for dilate and as in for erode. Exact for any radius, cost independent of it. Throws InvalidInput when radius < 0.
Mask dilate(const Mask& mask, double radius);
Mask erode(const Mask& mask, double radius);

/// Squared distance of each pixel to the nearest one of the mask (Felzenszwalb and Huttenlocher 2012); infinite without
/// any.
Plane squared_distance(const Mask& mask);

/// Share of pixels in both among those in either; 1 when both are empty. Throws InvalidInput when the sizes differ.
double intersection_over_union(const Mask& a, const Mask& b);

}  // namespace motex
