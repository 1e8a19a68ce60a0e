// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/image/planes.h"

namespace motex {

/// How many of something lie on each pixel: places are rounded, those outside the picture count at its border.
class PointCounts {
 public:
  PointCounts(int width, int height);
  void add(double x, double y, double weight = 1);
  double total() const { return total_; }
  const Plane& counts() const { return counts_; }

 private:
  Plane counts_;
  double total_ = 0;
};

/// Parzen window: every count spread as a Gaussian of that deviation, mirrored at the border, so that the sum stays and
/// what is even stays even. bandwidth 0 = as it is. Cost O(pixels · bandwidth).
Plane parzen_smooth(const Plane& counts, double bandwidth);

/// The deviation, 1 … a quarter of the shorter side in steps of √2, under which each point is most likely given all
/// others of its map (leave-one-out likelihood, 5 % of it spread evenly so that strays do not decide), summed over the
/// maps; not less than half the distance to a point's fourth neighbour (median), or points along a line, as at the
/// border, would stay dots. With fewer than two points in every map: a sixteenth of the shorter side.
double choose_bandwidth(const std::vector<const PointCounts*>& maps);

}  // namespace motex
