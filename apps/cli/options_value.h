// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "motex/core/options.h"
#include "value.h"

namespace motex::cli {

/// Field names and values of an options struct; "auto" and the names of choices as they are written in flags.
template <typename Options>
Value options_value(const Options& options) {
  Value object;
  const auto record = [&object](const Field& field, const auto& value, const auto& limits) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_enum_v<T>)
      object[field.name] = limits.names.at(static_cast<std::size_t>(value));
    else if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>)
      object[field.name] = limits.zero_is_auto && value == T{0} ? Value("auto") : Value(value);
    else
      object[field.name] = value;
  };
  Options::visit_fields(options, record);
  return object;
}

}  // namespace motex::cli
