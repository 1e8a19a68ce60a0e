// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "motex/plot/drawing.h"

namespace motex {

/// Built-in font made of pen strokes: ASCII and the signs that figures need (° – — × · − µ … → ² ≤ ≥). A character
/// without a glyph becomes an empty box.

/// Width of the text at that size of the em square.
double text_width(std::string_view utf8, double size);

/// Pen strokes of the text with the start of its base line at (0, 0), y down.
std::vector<std::vector<Point>> text_strokes(std::string_view utf8, double size);

/// Pen width for that size.
double pen_width(double size, bool bold);

}  // namespace motex
