// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "warnings.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace motex::cli {
namespace {

/// The text without numbers, quoted names and a leading "file: ".
std::string pattern_of(const std::string& warning) {
  const auto colon = warning.find(": ");
  const bool has_file = colon != std::string::npos && warning.find(' ') > colon;
  std::string pattern;
  bool quoted = false;
  for (const char c : warning.substr(has_file ? colon : 0)) {
    if (c == '\'' || c == '"') quoted = !quoted;
    const bool numeric = std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
    if (!quoted && !numeric) pattern += c;
  }
  return pattern;
}

}  // namespace

std::vector<std::string> fold_warnings(const std::vector<std::string>& warnings, std::size_t max_lines) {
  std::vector<std::string> lines;
  std::vector<int> counts;
  std::map<std::string, std::size_t> line_of_pattern;
  for (const std::string& warning : warnings) {
    const auto [place, is_new] = line_of_pattern.try_emplace(pattern_of(warning), lines.size());
    if (is_new) lines.push_back(on_one_line(warning)), counts.push_back(0);
    ++counts[place->second];
  }
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (counts[i] > 1) lines[i] += " (and " + std::to_string(counts[i] - 1) + " more like it)";
  if (lines.size() > max_lines) {
    const std::size_t left_out = lines.size() - max_lines;
    lines.resize(max_lines);
    if (max_lines > 0) lines.back() += " (and " + std::to_string(left_out) + " other warnings)";
  }
  return lines;
}

std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

}  // namespace motex::cli
