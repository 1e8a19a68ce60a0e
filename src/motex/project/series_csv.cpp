// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/series_csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "motex/core/csv.h"
#include "motex/core/error.h"
#include "motex/core/lowered.h"
#include "motex/core/trimmed.h"

namespace motex {
namespace {

/// The number of a cell, NaN for a gap; nothing for other text.
std::optional<double> number(std::string_view cell) {
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  if (cell.empty()) return kGap;
  if (cell.size() > 1 && cell[0] == '+' && cell[1] != '-') cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool whole = end == cell.data() + cell.size();
  if (whole && error == std::errc::result_out_of_range) return kGap;
  if (whole && error == std::errc()) return std::isfinite(value) ? value : kGap;
  const std::string word = lowered(cell);
  if (word == "na" || word == "null" || word == "n/a") return kGap;
  return std::nullopt;
}

char separator_of(std::string_view line) {
  for (const char c : {';', '\t', ','})
    if (line.find(c) != line.npos) return c;
  return ' ';
}

/// Tells which frame it is, not what is seen in it (those of motex people signals too).
bool only_counts(const std::string& name) {
  const std::string word = lowered(name);
  for (const char* known : {"frame", "frames", "time", "index", "start", "t", "time_secs", "secs", "seconds",
                            "source_frame", "person", "mirrored", "seen"})
    if (word == known) return true;
  return false;
}

std::string quoted(std::string_view text) { return "'" + std::string(text.substr(0, 40)) + "'"; }

std::vector<std::size_t> wanted(const std::vector<std::string>& names, const std::vector<std::string>& columns,
                                const std::vector<bool>& is_text, const std::string& file) {
  std::vector<std::size_t> out;
  for (const std::string& column : columns) {
    const auto at = std::find(names.begin(), names.end(), column);
    std::size_t place = static_cast<std::size_t>(at - names.begin());
    std::size_t counted = 0;
    const auto [end, error] = std::from_chars(column.data(), column.data() + column.size(), counted);
    if (at == names.end() && error == std::errc() && end == column.data() + column.size() && counted >= 1)
      place = counted - 1;
    if (place >= names.size()) {
      std::string known;
      for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
      throw InvalidInput(file + ": has no column " + quoted(column) + ", only " + known);
    }
    if (is_text[place]) throw InvalidInput(file + ": column " + quoted(column) + " holds text: a series is of numbers");
    out.push_back(place);
  }
  if (!columns.empty()) return out;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (!is_text[k] && (names.size() == 1 || !only_counts(names[k]))) out.push_back(k);
  for (std::size_t k = names.size(); out.empty() && k-- > 0;)
    if (!is_text[k]) out.push_back(k);
  return out;
}

}  // namespace

SeriesTable parse_series_csv(std::string_view text, const std::string& name, const std::vector<std::string>& columns) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  SeriesTable table;
  std::vector<double> values;
  std::vector<std::string> cells;
  std::vector<bool> is_text;  // of a column: its first cell under a heading
  std::size_t width = 0, num_finite = 0;
  char separator = 0;
  std::int64_t line_number = 0;
  const auto fail = [&](const std::string& message) {
    throw ParseError(name, ParseError::Unit::kLine, line_number, message);
  };
  while (!text.empty()) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, length));
    text.remove_prefix(std::min(text.size(), length + 1));
    ++line_number;
    if (line.empty() || line.front() == '#') continue;
    const bool is_first = width == 0;
    if (is_first) separator = separator_of(line);
    csv_cells(line, separator, cells);
    if (is_first) {
      width = cells.size();
      const bool is_heading = std::any_of(cells.begin(), cells.end(), [](const auto& cell) { return !number(cell); });
      for (std::size_t k = 0; k < width; ++k)
        table.names.push_back(is_heading && !cells[k].empty() ? cells[k] : std::to_string(k + 1));
      if (is_heading) continue;
    }
    if (cells.size() != width)
      fail(std::to_string(cells.size()) + (cells.size() == 1 ? " cell" : " cells") + " where the first line has " +
           std::to_string(width));
    for (std::size_t k = is_text.size(); k < width; ++k) is_text.push_back(width > 1 && !number(cells[k]));
    for (std::size_t k = 0; k < width; ++k) {
      const std::string& cell = cells[k];
      const std::optional<double> value = is_text[k] ? std::numeric_limits<double>::quiet_NaN() : number(cell);
      if (!value) fail(quoted(cell) + " is no number");
      values.push_back(*value);
      num_finite += std::isfinite(*value) ? 1 : 0;
    }
  }
  if (num_finite == 0) throw InvalidInput(name + ": there is no number in it: a series has one on each line");
  const std::vector<std::size_t> places = wanted(table.names, columns, is_text, name);
  const auto num_frames = static_cast<Index>(values.size() / width);
  table.values.resize(num_frames, static_cast<Index>(places.size()));
  std::vector<std::string> names;
  for (std::size_t k = 0; k < places.size(); ++k) {
    names.push_back(table.names[places[k]]);
    for (Index frame = 0; frame < num_frames; ++frame)
      table.values(frame, static_cast<Index>(k)) = values[static_cast<std::size_t>(frame) * width + places[k]];
  }
  table.names = std::move(names);
  return table;
}

}  // namespace motex
