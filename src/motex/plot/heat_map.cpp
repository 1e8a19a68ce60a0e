// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/plot/charts.h"
#include "motex/plot/colour.h"
#include "motex/plot/frame.h"

namespace motex {
namespace {

constexpr double kBarWidth = 14;

std::pair<double, double> value_range(const HeatMap& map) {
  double low = INFINITY, high = -INFINITY;
  for (const double v : map.values.reshaped())
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  if (!(low <= high)) low = 0, high = 1;
  low = map.min.value_or(low);
  high = map.max.value_or(high);
  return {low, high > low ? high : low + 1};
}

Image coloured(const Matrix& values, double low, double high) {
  Image image(static_cast<int>(values.cols()), static_cast<int>(values.rows()));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double v = values(y, x);
      image.at(x, y) = heat_colour(std::isfinite(v) ? (v - low) / (high - low) : NAN);
    }
  return image;
}

void draw_colour_bar(Drawing& drawing, const Frame& frame, const std::string& label, double low, double high) {
  constexpr int kSteps = 64;
  Image ramp(1, kSteps);
  for (int i = 0; i < kSteps; ++i) ramp.at(0, i) = heat_colour(1 - (i + 0.5) / kSteps);
  drawing.add(Picture{{frame.left, frame.top}, kBarWidth, frame.height, std::move(ramp)});
  const Scale scale = make_scale({"", false, low, high}, low, high, static_cast<int>(frame.height / 55));
  for (const Tick& tick : scale.ticks) {
    const double y = frame.top + frame.height * (1 - scale.place(tick.value));
    drawing.add(Polyline{{{frame.left + kBarWidth, y}, {frame.left + kBarWidth + 3, y}}, kFaintInk, 1, 0});
    drawing.add(Text{{frame.left + kBarWidth + 7, y + 4}, tick.text, kTickSize, kFaintInk, Align::kLeft, false, false});
  }
  if (!label.empty())
    drawing.add(Text{{frame.left + kBarWidth + y_axis_width(scale, label) - 2, frame.top + frame.height / 2},
                     label,
                     kLabelSize,
                     kInk,
                     Align::kCentre,
                     false,
                     true});
}

}  // namespace

Drawing draw(const HeatMap& map) {
  if (map.values.size() == 0) throw InvalidInput("the heat map '" + map.title + "' has no values");
  const auto [low, high] = value_range(map);
  const double unit = map.units_per_cell;
  const double rows = unit * static_cast<double>(map.values.rows()),
               cols = unit * static_cast<double>(map.values.cols());
  Scale x = make_scale({"", false, 0, cols}, 0, cols, static_cast<int>(map.size.width / 75));
  Scale y = make_scale({"", false, 0, rows}, 0, rows, static_cast<int>(map.size.height / 55));
  const auto keep_cells = [unit](Scale& scale, double count) {  // whole cells only, marked at their middle
    std::erase_if(scale.ticks, [&](const Tick& t) { return t.value != std::floor(t.value) || t.value >= count; });
    for (Tick& tick : scale.ticks) tick.value += unit / 2;
  };
  keep_cells(x, cols);
  keep_cells(y, rows);
  for (Tick& tick : y.ticks) tick.value = rows - tick.value;
  const Scale bar = make_scale({"", false, low, high}, low, high, static_cast<int>(map.size.height / 55));
  Drawing drawing{map.size.width, map.size.height, {255, 255, 255, 255}, {}};
  const double left = y_axis_width(y, map.y_label) + 4, top = map.title.empty() ? 10 : 30;
  const double right = kBarWidth + y_axis_width(bar, map.value_label) + 18;
  const Frame frame{left, top, map.size.width - left - right, map.size.height - top - (map.x_label.empty() ? 28 : 46)};
  if (frame.width < 20 || frame.height < 20)
    throw InvalidInput("the heat map '" + map.title + "' is too small for its labels");
  draw_title(drawing, map.title, left + frame.width / 2, 20);
  drawing.add(Picture{{frame.left, frame.top}, frame.width, frame.height, coloured(map.values, low, high)});
  draw_x_axis(drawing, frame, x, map.x_label, false);
  draw_y_axis(drawing, frame, y, map.y_label, false);
  draw_colour_bar(drawing, {frame.left + frame.width + 12, frame.top, kBarWidth, frame.height}, map.value_label, low,
                  high);
  return drawing;
}

}  // namespace motex
