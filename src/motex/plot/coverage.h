// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "motex/plot/drawing.h"

namespace motex {

/// Share of each pixel that outlines cover, computed exactly: every edge adds the signed area to its right, row by row,
/// and a running sum along the row gives the coverage. Cost: length of the edges in pixels + pixels of their box.
class Coverage {
 public:
  /// For a target of that many pixels; what lies outside is cut off.
  Coverage(int width, int height);

  /// Adds the inside of a closed outline, in pixels with (0, 0) at the corner of the top left pixel. Outlines of either
  /// direction count the same; where several overlap, coverage stops at 1.
  void add_outline(std::span<const Point> points);

  /// Blends the paint (in pixels) into the image where there is coverage, then forgets it.
  void paint(const Paint& paint, Image& image);

 private:
  void add_edge(Point from, Point to, double sign);
  void add_span(float* row, double x_a, double x_b, double area) const;
  int width_, height_;
  int first_row_;
  int last_row_ = -1;        // rows touched; none when first_row_ > last_row_
  std::vector<float> area_;  // height × (width + 2)
};

/// Outlines of a line of that width with round ends and joins.
std::vector<std::vector<Point>> stroke_outlines(std::span<const Point> points, double width);

/// The pieces that are drawn of a dashed line.
std::vector<std::vector<Point>> dashes(std::span<const Point> points, double length);

}  // namespace motex
