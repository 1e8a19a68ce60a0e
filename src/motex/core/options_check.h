// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <type_traits>

#include "motex/core/error.h"
#include "motex/core/options.h"

namespace motex {

struct RangeChecker {
  template <typename T>
  void operator()(const Field& field, const T& value, const Range& range) const {
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      const auto number = static_cast<double>(value);
      if (range.zero_is_auto && number == 0) return;
      if (!(number >= range.min && number <= range.max))
        throw InvalidInput(std::string(field.name) + " = " + text(value) + " is outside " + text(range.min) + " … " +
                           text(range.max) + (field.unit[0] != '\0' ? std::string(" ") + field.unit : std::string()));
    }
  }
  template <typename T>
  void operator()(const Field& field, const T& value, const Choices& choices) const {
    const auto idx = static_cast<std::size_t>(value);
    if (idx >= choices.names.size()) throw InvalidInput(std::string(field.name) + ": no such choice");
  }

 private:
  template <typename T>
  static std::string text(T value) {
    std::string s = std::to_string(value);
    if (s.find('.') != std::string::npos) {
      s.erase(s.find_last_not_of('0') + 1);
      if (s.back() == '.') s.pop_back();
    }
    return s;
  }
};

template <typename Options>
void check_options(const Options& options) {
  Options::visit_fields(options, RangeChecker{});
}

}  // namespace motex
