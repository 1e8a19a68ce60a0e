// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace motex::cli {

/// What a command reports, as --json prints it. Members keep the order in which they were added.
class Value {
 public:
  using List = std::vector<Value>;
  using Members = std::vector<std::pair<std::string, Value>>;

  Value() = default;
  Value(bool value) : data_(value) {}
  Value(int value) : data_(std::int64_t{value}) {}
  Value(std::int64_t value) : data_(value) {}
  Value(std::uint64_t value) : data_(value) {}
  Value(double value) : data_(value) {}
  Value(const char* value) : data_(std::string(value)) {}
  Value(std::string value) : data_(std::move(value)) {}
  Value(List value) : data_(std::move(value)) {}
  Value(Members value) : data_(std::move(value)) {}
  template <typename T>
  Value(const std::vector<T>& values) : data_(List(values.begin(), values.end())) {}

  /// The member of that name, added when it is not there. A null value becomes an object.
  Value& operator[](const std::string& name);
  /// Adds an element. A null value becomes a list.
  void append(Value element);

  const auto& data() const { return data_; }

 private:
  std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double, std::string, List, Members> data_;
};

/// On one line. Numbers that are not finite become null, broken UTF-8 becomes U+FFFD.
std::string to_json(const Value& value);

}  // namespace motex::cli
