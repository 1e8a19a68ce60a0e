// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/image/planes.h"

namespace motex {

struct ContourPoint {
  double x = 0, y = 0;  ///< pixels, pixel centres at integers
};

/// A closed line; the last point joins the first.
using Contour = std::vector<ContourPoint>;

/// Outlines of the regions where the plane is at least `level`, linear between pixel centres (marching squares); beyond
/// the border counts as far below. Outer outlines run clockwise as seen (y down), holes the other way.
std::vector<Contour> contours(const Plane& plane, float level);

/// Area inside, square pixels; negative for a hole.
double signed_area(const Contour& contour);

}  // namespace motex
