// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "motex/core/error.h"
#include "motex/plot/charts.h"
#include "motex/plot/colour.h"
#include "motex/plot/frame.h"
#include "motex/plot/stroke_font.h"

namespace motex {
namespace {

bool shown(const Axis& axis, double value) { return std::isfinite(value) && (!axis.log || value > 0); }

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

Rgba colour_of(const LinePlot& plot, std::size_t idx) {
  return plot.series[idx].colour.value_or(series_colour(static_cast<int>(idx)));
}

bool inside(const Frame& frame, Point p) {
  return p.x >= frame.left - 0.01 && p.x <= frame.left + frame.width + 0.01 && p.y >= frame.top - 0.01 &&
         p.y <= frame.top + frame.height + 0.01;
}

/// Cuts the segment a b to the frame (Liang-Barsky). False when nothing is left.
bool clip_segment(const Frame& frame, Point& a, Point& b) {
  const Point from = a, step{b.x - a.x, b.y - a.y};
  double enter = 0, leave = 1;
  const auto cut = [&](double direction, double room) {  // keeps t with direction · t ≤ room
    if (direction == 0) return room >= 0;
    const double t = room / direction;
    if (direction < 0) enter = std::max(enter, t);
    if (direction > 0) leave = std::min(leave, t);
    return enter <= leave;
  };
  if (!cut(-step.x, from.x - frame.left) || !cut(step.x, frame.left + frame.width - from.x) ||
      !cut(-step.y, from.y - frame.top) || !cut(step.y, frame.top + frame.height - from.y))
    return false;
  if (enter > 0) a = {from.x + enter * step.x, from.y + enter * step.y};
  if (leave < 1) b = {from.x + leave * step.x, from.y + leave * step.y};
  return true;
}

/// Polylines of the parts of a run of points that lie inside the frame.
std::vector<std::vector<Point>> clipped_lines(const Frame& frame, const std::vector<Point>& run) {
  std::vector<std::vector<Point>> lines;
  bool joined = false;
  for (std::size_t i = 1; i < run.size(); ++i) {
    Point a = run[i - 1], b = run[i];
    if (!clip_segment(frame, a, b)) {
      joined = false;
      continue;
    }
    if (!joined) lines.push_back({a});
    lines.back().push_back(b);
    joined = inside(frame, run[i]);
  }
  return lines;
}

void draw_run(Drawing& drawing, const Frame& frame, Mark mark, const std::vector<Point>& run, Rgba colour) {
  if (mark != Mark::kPoints)
    for (auto& line : clipped_lines(frame, run)) drawing.add(Polyline{std::move(line), colour, 1.8, 0});
  if (mark == Mark::kLine && run.size() > 1) return;
  for (const Point& p : run)
    if (inside(frame, p)) drawing.add(Disc{p, mark == Mark::kPoints ? 2.4 : 3.0, colour});
}

void draw_series(Drawing& drawing, const LinePlot& plot, std::size_t idx, const Frame& frame, const Scale& x,
                 const Scale& y) {
  const Series& series = plot.series[idx];
  std::vector<Point> run;
  const auto flush = [&] {
    if (!run.empty()) draw_run(drawing, frame, series.mark, run, colour_of(plot, idx));
    run.clear();
  };
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (shown(plot.x_axis, series.x[i]) && shown(plot.y_axis, series.y[i]))
      run.push_back(frame.at(x, y, series.x[i], series.y[i]));
    else
      flush();
  }
  flush();
}

void draw_markers(Drawing& drawing, const LinePlot& plot, const Frame& frame, const Scale& x) {
  for (const Marker& marker : plot.x_markers) {
    const double place = x.place(marker.at);
    if (!shown(plot.x_axis, marker.at) || place < 0 || place > 1) continue;
    const double at = frame.left + frame.width * place;
    const bool left = place > 0.6;
    drawing.add(Polyline{{{at, frame.top}, {at, frame.top + frame.height}}, kFaintInk, 1, 4});
    drawing.add(Text{{at + (left ? -5 : 5), frame.top + 13},
                     marker.text,
                     kTickSize,
                     kFaintInk,
                     left ? Align::kRight : Align::kLeft,
                     false,
                     false});
  }
}

constexpr double kLegendRow = 17, kSwatch = 18;

/// Entries from the left, wrapped to the width. Returns the height used; nothing is drawn when `drawing` is null.
double draw_legend(Drawing* drawing, const LinePlot& plot, double left, double top, double width) {
  double x = left, y = top;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    if (series.name.empty()) continue;
    const double entry = kSwatch + 5 + text_width(series.name, kTickSize) + 14;
    if (x > left && x + entry > left + width) x = left, y += kLegendRow;
    if (drawing != nullptr) {
      const Point a{x + 2, y + 8}, b{x + kSwatch - 2, y + 8};
      if (series.mark != Mark::kPoints) drawing->add(Polyline{{a, b}, colour_of(plot, i), 1.8, 0});
      if (series.mark != Mark::kLine) drawing->add(Disc{{x + kSwatch / 2, y + 8}, 3, colour_of(plot, i)});
      drawing->add(Text{{x + kSwatch + 5, y + 12}, series.name, kTickSize, kInk, Align::kLeft, false, false});
    }
    x += entry;
  }
  return x > left || y > top ? y - top + kLegendRow + 4 : 0;
}

}  // namespace

Drawing draw(const LinePlot& plot) {
  Extent x_extent, y_extent;
  for (const Series& series : plot.series) {
    if (series.x.size() != series.y.size())
      throw InvalidInput("series '" + series.name + "' has " + std::to_string(series.x.size()) + " x and " +
                         std::to_string(series.y.size()) + " y values");
    for (std::size_t i = 0; i < series.x.size(); ++i)
      if (shown(plot.x_axis, series.x[i]) && shown(plot.y_axis, series.y[i]))
        x_extent.include(series.x[i]), y_extent.include(series.y[i]);
  }
  Drawing drawing{plot.size.width, plot.size.height, {255, 255, 255, 255}, {}};
  const Scale y = make_scale(plot.y_axis, y_extent.low, y_extent.high, static_cast<int>(plot.size.height / 55));
  const Scale x = make_scale(plot.x_axis, x_extent.low, x_extent.high, static_cast<int>(plot.size.width / 75));
  const double left = y_axis_width(y, plot.y_axis.label) + 4, title = plot.title.empty() ? 10 : 30;
  const double width = plot.size.width - left - 18;
  const double top = title + draw_legend(nullptr, plot, left, title, width);
  const Frame frame{left, top, width, plot.size.height - top - (plot.x_axis.label.empty() ? 28 : 46)};
  if (frame.width < 20 || frame.height < 20)
    throw InvalidInput("the plot '" + plot.title + "' is too small for its labels");
  draw_title(drawing, plot.title, left + width / 2, 20);
  draw_legend(&drawing, plot, left, title, width);
  draw_x_axis(drawing, frame, x, plot.x_axis.label, true);
  draw_y_axis(drawing, frame, y, plot.y_axis.label, true);
  draw_markers(drawing, plot, frame, x);
  for (std::size_t i = 0; i < plot.series.size(); ++i) draw_series(drawing, plot, i, frame, x, y);
  return drawing;
}

}  // namespace motex
