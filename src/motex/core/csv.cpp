// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/core/csv.h"

#include <charconv>
#include <cmath>
#include <cstddef>

#include "motex/core/trimmed.h"

namespace motex {
namespace {

/// One cell from the beginning of the line; how many characters it takes, the separator not among them.
std::size_t read_cell(std::string_view line, char separator, std::string& cell) {
  cell.clear();
  bool quoted = false;
  std::size_t i = 0;
  for (; i < line.size() && (quoted || line[i] != separator); ++i)
    if (line[i] != '"')
      cell += line[i];
    else if (quoted && i + 1 < line.size() && line[i + 1] == '"')
      cell += line[i++];
    else
      quoted = !quoted;
  const std::string_view kept = trimmed(cell);
  cell.erase(0, static_cast<std::size_t>(kept.data() - cell.data())).resize(kept.size());
  return i;
}

}  // namespace

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"#\r\n") == text.npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) out.append(c == '"' ? 2 : 1, c);
  return out + '"';
}

void csv_cells(std::string_view line, char separator, std::vector<std::string>& cells) {
  std::size_t count = 0;
  while (true) {
    if (cells.size() == count) cells.emplace_back();
    const std::size_t size = read_cell(line, separator, cells[count]);
    if (separator != ' ' || !cells[count].empty()) ++count;
    if (size == line.size()) break;
    line.remove_prefix(size + 1);
  }
  cells.resize(count);
}

void append_number(std::string& text, double value) {
  char buffer[32];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

void append_rounded(std::string& text, double value, int places) {
  const double steps = std::pow(10.0, places);
  append_number(text, std::round(value * steps) / steps + 0.0);  // + 0.0: no −0
}

std::string rounded_text(double value, int places) {
  std::string text;
  append_rounded(text, value, places);
  return text;
}

}  // namespace motex
