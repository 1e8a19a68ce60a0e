// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/plot/axis.h"
#include "motex/plot/drawing.h"

namespace motex {

inline constexpr Rgba kInk{38, 42, 51, 255};
inline constexpr Rgba kFaintInk{104, 110, 122, 255};
inline constexpr Rgba kGridLine{228, 230, 235, 255};
inline constexpr double kLabelSize = 12;
inline constexpr double kTickSize = 11;
inline constexpr double kTitleSize = 14;

/// The rectangle inside the axes.
struct Frame {
  double left, top, width, height;
  Point at(const Scale& x, const Scale& y, double x_value, double y_value) const;
};

/// Title above, grid lines, ticks, tick texts and labels around the frame.
void draw_title(Drawing& drawing, const std::string& title, double centre_x, double base_line);
void draw_x_axis(Drawing& drawing, const Frame& frame, const Scale& scale, const std::string& label, bool with_grid);
void draw_y_axis(Drawing& drawing, const Frame& frame, const Scale& scale, const std::string& label, bool with_grid);
/// Width that the y axis needs left of the frame.
double y_axis_width(const Scale& scale, const std::string& label);

}  // namespace motex
