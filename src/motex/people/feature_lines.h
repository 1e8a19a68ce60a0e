// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/people/feature_line.h"
#include "motex/people/outline.h"
#include "motex/people/people_texture.h"

namespace motex {

/// A frame of a people texture at its place in the film.
struct PlacedFrame {
  int frame = 0;
  Placement placement;
};

/// The horizontal and vertical edges of the bounding box that stay where they are over the frames ± 5 around both
/// frames (within their takes): the farthest they get from their place is at most 2 % of the box's height. Each is a
/// line along that side of the box. [PT04] section 3.2, Figure 7
std::vector<FeatureLinePair> fixed_edges(const PeopleTexture& texture, const PlacedFrame& a, const PlacedFrame& b);
/// All four sides: what the paper's morph has left where no edge is fixed.
std::vector<FeatureLinePair> box_edges(const PeopleTexture& texture, const PlacedFrame& a, const PlacedFrame& b);

/// Pieces of both outlines that match in place, direction and colour, about 32 round the silhouette, and an axis to
/// each tip that has a counterpart: head, hands, feet. A piece without a counterpart (a hand that is hidden in one
/// picture) gives no line. The sprites must lie on one another already.
std::vector<FeatureLinePair> outline_lines(const PlacedSprite& a, const PlacedSprite& b);

/// Which points of `a` are tips that some tip of `b` matches, as pairs of points.
std::vector<std::array<int, 2>> matched_tips(const Outline& a, const Outline& b, const std::vector<double>& places);

}  // namespace motex
