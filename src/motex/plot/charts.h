// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "motex/core/matrix.h"
#include "motex/plot/axis.h"
#include "motex/plot/drawing.h"

namespace motex {

/// Size of a plot with its labels, in the drawing's units.
struct PlotSize {
  double width = 480;
  double height = 320;
};

enum class Mark { kLine, kPoints, kLineAndPoints };

struct Series {
  std::string name;  ///< for the legend; "" = not listed
  std::vector<double> x;
  std::vector<double> y;  ///< as many as x; a value that is not finite breaks the line
  Mark mark = Mark::kLine;
  std::optional<Rgba> colour;  ///< default: series_colour(position in the list)
};

/// A dashed line across the plot with its name beside it.
struct Marker {
  double at;
  std::string text;
};

/// Line plot or, with Mark::kPoints, scatter plot.
struct LinePlot {
  std::string title;
  Axis x_axis, y_axis;
  std::vector<Series> series;
  std::vector<Marker> x_markers;  ///< vertical lines
  PlotSize size;
};

/// Matrix as colours, row 0 on top, with a colour bar. Values that are not finite are grey.
struct HeatMap {
  std::string title, x_label, y_label, value_label;
  Matrix values;
  std::optional<double> min, max;  ///< values of the ends of the colour scale; default: the smallest and largest
  PlotSize size;
  double units_per_cell = 1;  ///< of both axes, whose numbers are units from 0
};

/// A stretch of time in the colour of its unit.
struct StripSegment {
  double start = 0;
  double length = 0;
  int unit = 0;       ///< unit_colour(unit)
  std::string label;  ///< written inside when there is room
};
struct StripRow {
  std::string label;
  std::vector<StripSegment> segments;
};
/// Coloured segments along time, one row each.
struct StripPlot {
  std::string title;
  Axis x_axis;
  std::vector<StripRow> rows;
  double width = 900;
  double row_height = 26;
};

/// Each throws InvalidInput when series have unequal sizes or there is nothing to show.
Drawing draw(const LinePlot& plot);
Drawing draw(const HeatMap& map);
Drawing draw(const StripPlot& strip);

/// Only the segments, scaled so that times first … last fill the width; no axis.
Drawing draw_segments(const std::vector<StripSegment>& segments, double first, double last, double width,
                      double height);

/// Panels row by row in that many columns, under a common title ("" = none). Throws InvalidInput without panels.
Drawing grid(const std::vector<Drawing>& panels, int columns, const std::string& title);

}  // namespace motex
