// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/image/warp_grid.h"
#include "motex/people/silhouette.h"
#include "motex/people/sprite.h"

namespace motex {

/// Where a frame's pixels are put in the film: pixel p at scale · p + (x, y).
struct Placement {
  double scale = 1;
  double x = 0, y = 0;  ///< pixels

  bool is_whole_pixels() const;  ///< nothing is resampled
  friend bool operator==(const Placement&, const Placement&) = default;
};

/// Sides on which the frame's edge cuts the actor off; there the sprite's edge pixels go on outwards when it is warped.
struct CutOffSides {
  bool left = false, top = false, right = false, bottom = false;
};
/// The sides on which the sprite reaches the edge of a frame of that size.
CutOffSides cut_off_sides(const Sprite& sprite, int width, int height);

/// A sprite and its place in the film.
struct PlacedSprite {
  const Sprite& sprite;
  Placement placement;
  CutOffSides cut_off = {};
};

/// Pixels of the film that the sprite touches; empty for an empty sprite.
BoundingBox box_of(const Sprite& sprite, const Placement& placement = {});
/// The smallest box around both; an empty one counts for nothing.
BoundingBox joined(const BoundingBox& a, const BoundingBox& b);

/// The sprite put there: the same pixels where they only move by whole pixels, else cubic interpolation (Catmull–Rom).
Sprite placed(const Sprite& sprite, const Placement& placement);

/// A sprite warped: pixel p of the film shows the sprite's place of p + u(p).
struct WarpedSprite {
  const PlacedSprite& source;
  const WarpGrid& warp;
};

/// The warped sprite over the pixels of `box`, bilinear. The grid must start at the box's corner and cover it. Throws
/// InvalidInput.
Sprite warped(const WarpedSprite& sprite, const BoundingBox& box, int jobs = 0);
/// (1 − weight) · a + weight · b of two warped sprites, premultiplied colours and alpha alike, bilinear, over the
/// pixels of `box`. Both grids must start at the box's corner, with one spacing, and cover it. Cost about 8 ns a pixel.
/// Throws InvalidInput.
Sprite dissolved(const WarpedSprite& a, const WarpedSprite& b, double weight, const BoundingBox& box, int jobs = 0);

}  // namespace motex
