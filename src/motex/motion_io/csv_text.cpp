// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/csv_text.h"

#include <charconv>
#include <cmath>

namespace motex {

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

void append_csv_number(std::string& text, double value) {
  constexpr double kSteps = 1e9;
  char buffer[40];
  const double rounded = std::round(value * kSteps) / kSteps + 0.0;  // + 0.0: no −0
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, rounded).ptr);
}

}  // namespace motex
