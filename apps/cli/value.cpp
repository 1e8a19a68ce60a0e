// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "value.h"

#include <nlohmann/json.hpp>
#include <type_traits>

namespace motex::cli {
namespace {

nlohmann::ordered_json json(const Value& value);

nlohmann::ordered_json json_list(const Value::List& list) {
  auto out = nlohmann::ordered_json::array();
  for (const Value& element : list) out.push_back(json(element));
  return out;
}

nlohmann::ordered_json json_object(const Value::Members& members) {
  auto out = nlohmann::ordered_json::object();
  for (const auto& [name, member] : members) out[name] = json(member);
  return out;
}

nlohmann::ordered_json json(const Value& value) {
  return std::visit(
      [](const auto& data) -> nlohmann::ordered_json {
        using T = std::decay_t<decltype(data)>;
        if constexpr (std::is_same_v<T, std::monostate>)
          return nullptr;
        else if constexpr (std::is_same_v<T, Value::List>)
          return json_list(data);
        else if constexpr (std::is_same_v<T, Value::Members>)
          return json_object(data);
        else
          return data;
      },
      value.data());
}

}  // namespace

Value& Value::operator[](const std::string& name) {
  if (std::holds_alternative<std::monostate>(data_)) data_ = Members();
  auto& members = std::get<Members>(data_);
  for (auto& [known, member] : members)
    if (known == name) return member;
  return members.emplace_back(name, Value()).second;
}

void Value::append(Value element) {
  if (std::holds_alternative<std::monostate>(data_)) data_ = List();
  std::get<List>(data_).push_back(std::move(element));
}

std::string to_json(const Value& value) {
  return json(value).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace motex::cli
