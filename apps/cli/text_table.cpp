// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "text_table.h"

#include <algorithm>
#include <cstdio>

namespace motex::cli {
namespace {

std::size_t num_columns(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

bool looks_like_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789.-+e%– ") == std::string::npos;
}

}  // namespace

std::string text_table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  std::vector<bool> numeric;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    widths.resize(std::max(widths.size(), rows[row].size()));
    numeric.resize(widths.size(), true);
    for (std::size_t col = 0; col < rows[row].size(); ++col) {
      widths[col] = std::max(widths[col], num_columns(rows[row][col]));
      if (row > 0 && !looks_like_number(rows[row][col])) numeric[col] = false;
    }
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t col = 0; col < row.size(); ++col) {
      const std::string padding(widths[col] - num_columns(row[col]), ' ');
      line += (col > 0 ? "  " : "") + (numeric[col] ? padding + row[col] : row[col] + padding);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string text_pairs(const std::vector<std::pair<std::string, std::string>>& pairs) {
  std::size_t width = 0;
  for (const auto& [name, value] : pairs) width = std::max(width, num_columns(name));
  std::string text;
  for (const auto& [name, value] : pairs) text += name + std::string(width - num_columns(name) + 2, ' ') + value + "\n";
  return text;
}

std::string fixed(double value, int decimals) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, value);
  return buffer;
}

}  // namespace motex::cli
