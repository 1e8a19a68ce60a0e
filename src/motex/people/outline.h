// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "motex/people/warp_sprites.h"

namespace motex {

/// A place on a silhouette's outline.
struct OutlinePoint {
  double x = 0, y = 0;                ///< pixels of the film
  double normal_x = 0, normal_y = 0;  ///< outwards, length 1
  std::array<float, 3> colour{};      ///< R, G, B a little way inside, 0 … 255
};

/// The outline of the largest part of a silhouette (alpha ½), clockwise as seen, at points equally far apart.
struct Outline {
  std::vector<OutlinePoint> points;
  double step = 0;        ///< pixels along the outline from one point to the next
  double height = 0;      ///< of the sprite in the film, pixels
  std::vector<int> tips;  ///< points farthest from the middle among those around: head, hands, feet. Rising

  int size() const { return static_cast<int>(points.size()); }
  const OutlinePoint& point(int i) const;  ///< counted on round the outline, i any whole number
};

/// Empty for a sprite without pixels of alpha ≥ ½. The star skeleton's tips: maxima of the distance from the outline's
/// mean point that rise by 6 % of the height above the dips at both sides [Fujiyoshi and Lipton 1998].
/// Throws InvalidInput unless num_points ≥ 8.
Outline outline_of(const PlacedSprite& sprite, int num_points = 128);

/// For each point of `a` the matching place of `b` in points (between them, counted on from 0 and rising by b.size()
/// once round): the way round both that costs least in distance, direction and colour (cyclic dynamic time warping).
/// Empty when an outline is. Both must lie on one another already.
std::vector<double> match_outlines(const Outline& a, const Outline& b);

/// Linear between points.
OutlinePoint point_between(const Outline& outline, double place);

}  // namespace motex
