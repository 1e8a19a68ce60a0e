// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "motex/core/matrix.h"

namespace motex {

/// Signals over time: rows = frames, columns = signals.
struct SeriesTable {
  FrameMatrix values;              ///< NaN where nothing was measured
  std::vector<std::string> names;  ///< of the columns; "1", "2", … without a heading
};

/// A table of numbers, one frame a line: separators comma, semicolon, tab or blanks; a heading in the first line if it
/// holds anything but numbers; lines that are empty or begin with # are skipped; an empty cell, nan, na, null and inf
/// are gaps. columns: names (or numbers from 1) of those wanted, in this order; empty = all but those that only tell
/// which frame it is (frame, time, index, start, t, …) and those whose first cell is text (the source in a table of
/// motex people signals). Throws ParseError with the line (text where a number belongs, too few or too many cells),
/// InvalidInput (no number at all, no such column, one of text). name: for messages.
SeriesTable parse_series_csv(std::string_view text, const std::string& name,
                             const std::vector<std::string>& columns = {});

}  // namespace motex
