// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "motex/core/error.h"
#include "motex/plot/charts.h"
#include "motex/plot/colour.h"
#include "motex/plot/frame.h"
#include "motex/plot/stroke_font.h"

namespace motex {

Drawing draw_segments(const std::vector<StripSegment>& segments, double first, double last, double width,
                      double height) {
  if (!(last > first)) throw InvalidInput("a strip must span some time");
  Drawing drawing{width, height, {255, 255, 255, 255}, {}};
  const double scale = width / (last - first);
  for (const StripSegment& segment : segments) {
    const double left = (std::max(segment.start, first) - first) * scale;
    const double right = (std::min(segment.start + segment.length, last) - first) * scale;
    if (right <= left) continue;
    const double gap = std::min(1.0, (right - left) * 0.15);
    drawing.add(Polygon{rectangle({left, 0}, right - left - gap, height), {unit_colour(segment.unit), {}, {}, {}}});
    if (text_width(segment.label, kTickSize) < right - left - 6)
      drawing.add(Text{{(left + right) / 2, height / 2 + 4},
                       segment.label,
                       kTickSize,
                       {16, 18, 24, 255},
                       Align::kCentre,
                       false,
                       false});
  }
  return drawing;
}

Drawing draw(const StripPlot& strip) {
  if (strip.rows.empty()) throw InvalidInput("the strip '" + strip.title + "' has no row");
  double low = std::numeric_limits<double>::infinity(), high = -low, label_width = 0;
  for (const StripRow& row : strip.rows) {
    label_width = std::max(label_width, text_width(row.label, kTickSize));
    for (const StripSegment& segment : row.segments)
      low = std::min(low, segment.start), high = std::max(high, segment.start + segment.length);
  }
  if (!(low < high)) low = 0, high = 1;
  Axis ends = strip.x_axis;
  ends.min = ends.min.value_or(low);
  ends.max = ends.max.value_or(high);
  const Scale x = make_scale(ends, low, high, static_cast<int>(strip.width / 75));
  const double left = label_width + (label_width > 0 ? 18 : 12), top = strip.title.empty() ? 10 : 30;
  const double row_step = strip.row_height + 6;
  const Frame frame{left, top, strip.width - left - 18, row_step * static_cast<double>(strip.rows.size())};
  Drawing drawing{strip.width, top + frame.height + (strip.x_axis.label.empty() ? 28 : 46), {255, 255, 255, 255}, {}};
  draw_title(drawing, strip.title, left + frame.width / 2, 20);
  for (std::size_t i = 0; i < strip.rows.size(); ++i) {
    const double y = top + row_step * static_cast<double>(i);
    append(drawing, draw_segments(strip.rows[i].segments, x.min, x.max, frame.width, strip.row_height), {left, y});
    drawing.add(Text{
        {left - 8, y + strip.row_height / 2 + 4}, strip.rows[i].label, kTickSize, kInk, Align::kRight, false, false});
  }
  draw_x_axis(drawing, frame, x, strip.x_axis.label, false);
  return drawing;
}

}  // namespace motex
