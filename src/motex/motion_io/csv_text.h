// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace motex {

/// A word as a cell of a CSV file (RFC 4180): in quotes where it holds commas, quotes or line ends.
std::string csv_cell(const std::string& text);

/// The shortest decimal of `value` rounded to 1e-9; no −0.
void append_csv_number(std::string& text, double value);

}  // namespace motex
