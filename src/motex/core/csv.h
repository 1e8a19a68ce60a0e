// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace motex {

/// A word as a cell of a CSV file (RFC 4180): in quotes where it holds commas, quotes or line ends, or a # that would
/// begin a comment.
std::string csv_cell(std::string_view text);

/// The cells of a line of a CSV file, without the blanks and quotes around them; a separator within quotes belongs to
/// the cell, two quotes there are one. Separator ' ': any number of them. `cells` is overwritten; its memory is kept.
void csv_cells(std::string_view line, char separator, std::vector<std::string>& cells);

/// The shortest decimal that is read back as the same number.
void append_number(std::string& text, double value);

/// The shortest decimal of the value rounded to so many places; no −0.
void append_rounded(std::string& text, double value, int places);
std::string rounded_text(double value, int places);

}  // namespace motex
