// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace motex::cli {

/// Warnings that differ only in their numbers or in the file that they begin with become one: "… (and 11 more like
/// it)". At most max_lines lines.
std::vector<std::string> fold_warnings(const std::vector<std::string>& warnings, std::size_t max_lines);

/// Line breaks become spaces.
std::string on_one_line(std::string text);

}  // namespace motex::cli
