// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/plot/frame.h"

#include <algorithm>

#include "motex/plot/stroke_font.h"

namespace motex {

Point Frame::at(const Scale& x, const Scale& y, double x_value, double y_value) const {
  return {left + width * x.place(x_value), top + height * (1 - y.place(y_value))};
}

void draw_title(Drawing& drawing, const std::string& title, double centre_x, double base_line) {
  if (!title.empty()) drawing.add(Text{{centre_x, base_line}, title, kTitleSize, kInk, Align::kCentre, true, false});
}

void draw_x_axis(Drawing& drawing, const Frame& frame, const Scale& scale, const std::string& label, bool with_grid) {
  const double bottom = frame.top + frame.height;
  double free_from = -1e9;
  for (const Tick& tick : scale.ticks) {
    const double x = frame.left + frame.width * scale.place(tick.value);
    if (with_grid) drawing.add(Polyline{{{x, frame.top}, {x, bottom}}, kGridLine, 1, 0});
    drawing.add(Polyline{{{x, bottom}, {x, bottom + 4}}, kFaintInk, 1, 0});
    const double half = text_width(tick.text, kTickSize) / 2;
    if (x - half < free_from) continue;
    drawing.add(Text{{x, bottom + 17}, tick.text, kTickSize, kFaintInk, Align::kCentre, false, false});
    free_from = x + half + 4;
  }
  drawing.add(Polyline{{{frame.left, bottom}, {frame.left + frame.width, bottom}}, kFaintInk, 1, 0});
  if (!label.empty())
    drawing.add(
        Text{{frame.left + frame.width / 2, bottom + 35}, label, kLabelSize, kInk, Align::kCentre, false, false});
}

void draw_y_axis(Drawing& drawing, const Frame& frame, const Scale& scale, const std::string& label, bool with_grid) {
  for (const Tick& tick : scale.ticks) {
    const double y = frame.top + frame.height * (1 - scale.place(tick.value));
    if (with_grid) drawing.add(Polyline{{{frame.left, y}, {frame.left + frame.width, y}}, kGridLine, 1, 0});
    drawing.add(Polyline{{{frame.left - 4, y}, {frame.left, y}}, kFaintInk, 1, 0});
    drawing.add(Text{{frame.left - 7, y + 4}, tick.text, kTickSize, kFaintInk, Align::kRight, false, false});
  }
  drawing.add(Polyline{{{frame.left, frame.top}, {frame.left, frame.top + frame.height}}, kFaintInk, 1, 0});
  if (!label.empty())
    drawing.add(Text{{frame.left - y_axis_width(scale, label) + 16, frame.top + frame.height / 2},
                     label,
                     kLabelSize,
                     kInk,
                     Align::kCentre,
                     false,
                     true});
}

double y_axis_width(const Scale& scale, const std::string& label) {
  double widest = 0;
  for (const Tick& tick : scale.ticks) widest = std::max(widest, text_width(tick.text, kTickSize));
  return widest + 12 + (label.empty() ? 4 : 22);
}

}  // namespace motex
