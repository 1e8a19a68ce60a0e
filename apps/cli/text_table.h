// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace motex::cli {

/// Columns for a person: the first row is the heading; columns of numbers stand to the right.
std::string text_table(const std::vector<std::vector<std::string>>& rows);

/// "name  value" lines.
std::string text_pairs(const std::vector<std::pair<std::string, std::string>>& pairs);

/// Fixed number of decimals.
std::string fixed(double value, int decimals);

}  // namespace motex::cli
