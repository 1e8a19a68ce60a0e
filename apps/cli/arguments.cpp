// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "closest.h"
#include "motex/core/error.h"

namespace motex::cli {
namespace {

/// The whole text as a number, without a '+' or spaces around it.
template <typename T>
bool number_from(const std::string& text, T& value) {
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc() && result.ptr == end && !text.empty();
}

template <typename T>
void parse_whole(const std::string& argument, const std::string& text, T& value) {
  if (!number_from(text, value)) throw InvalidInput(argument + ": '" + text + "' is not a whole number");
}

std::string number_text(double value) {
  char buffer[32];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 6);
  return {buffer, result.ptr};
}

void check_range(const std::string& flag, const Field& field, double value, const Range& range) {
  if (value >= range.min && value <= range.max) return;
  const std::string unit = field.unit[0] != '\0' ? std::string(" ") + field.unit : "";
  throw InvalidInput(flag + ": " + number_text(value) + " is outside " + number_text(range.min) + " … " +
                     number_text(range.max) + unit + (range.zero_is_auto ? " (or auto)" : ""));
}

std::string with_default(const Field& field, const std::string& default_text) {
  std::string text = field.help;
  std::string more = field.unit;
  if (!default_text.empty()) more += (more.empty() ? "default " : ", default ") + default_text;
  return more.empty() ? text : text + " (" + more + ")";
}

}  // namespace

std::string flag_name(const std::string& field_name) {
  std::string flag = "--" + field_name;
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

void parse_value(const std::string& argument, const std::string& text, double& value) {
  if (!number_from(text, value) || !std::isfinite(value))
    throw InvalidInput(argument + ": '" + text + "' is not a number");
}
void parse_value(const std::string& argument, const std::string& text, int& value) {
  parse_whole(argument, text, value);
}
void parse_value(const std::string& argument, const std::string& text, std::int64_t& value) {
  parse_whole(argument, text, value);
}
void parse_value(const std::string& argument, const std::string& text, std::uint64_t& value) {
  parse_whole(argument, text, value);
}
void parse_value(const std::string& argument, const std::string& text, std::string& value) {
  if (text.empty()) throw InvalidInput(argument + ": is empty");
  value = text;
}

std::size_t parse_choice(const std::string& argument, const std::string& text,
                         const std::vector<std::string>& choices) {
  const auto found = std::find(choices.begin(), choices.end(), text);
  if (found == choices.end())
    throw InvalidInput(argument + ": '" + text + "' is none of " + enumerate(choices) + did_you_mean(text, choices));
  return static_cast<std::size_t>(found - choices.begin());
}

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; !text.empty() && at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    words.push_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  return words;
}

Argument& Arguments::append(const std::string& flags, const std::string& placeholder, const std::string& help) {
  Argument& argument = arguments_.emplace_back();
  argument.section = section_;
  argument.placeholder = placeholder;
  argument.help = help;
  const auto comma = flags.find(',');
  argument.flag = comma == std::string::npos ? flags : flags.substr(comma + 1);
  if (comma != std::string::npos) argument.short_flag = flags.substr(0, comma);
  return argument;
}

Argument& Arguments::toggle(const std::string& flags, const std::string& help, bool& target) {
  Argument& argument = append(flags, "", help);
  argument.set = [&target](const std::string& text) { target = text == "true"; };
  return argument;
}

bool Arguments::has(const std::string& flag) const {
  return std::any_of(arguments_.begin(), arguments_.end(), [&](const Argument& known) { return known.flag == flag; });
}

void FieldDeclarer::operator()(const Field& field, bool& value, const Range&) const {
  const std::string flag = flag_name(field.name);
  Argument& argument = arguments.toggle(flag, with_default(field, value ? "on" : ""), value);
  argument.negation = "--no-" + flag.substr(2);
}

void FieldDeclarer::operator()(const Field& field, std::string& value, const Range&) const {
  arguments.value(flag_name(field.name), "TEXT", with_default(field, value), value);
}

template <typename T>
void FieldDeclarer::number(const Field& field, T& value, const Range& range) const {
  const std::string flag = flag_name(field.name);
  const bool is_auto = range.zero_is_auto && value == T{0};
  std::string default_text = std::is_integral_v<T> ? std::to_string(value) : number_text(static_cast<double>(value));
  if (is_auto) default_text = "auto";
  Argument& argument =
      arguments.value(flag, std::is_integral_v<T> ? "N" : "X", with_default(field, default_text), value);
  argument.set = [flag, field, range, &value](const std::string& text) {
    if (range.zero_is_auto && text == "auto") {
      value = T{0};
      return;
    }
    parse_value(flag, text, value);
    check_range(flag, field, static_cast<double>(value), range);
  };
}

void FieldDeclarer::declare_choice(const Field& field, std::size_t current, const std::vector<std::string>& names,
                                   const std::function<void(std::size_t)>& assign) const {
  const std::string flag = flag_name(field.name);
  std::string placeholder;
  for (const std::string& name : names) placeholder += (placeholder.empty() ? "" : "|") + name;
  Argument& argument = arguments.append(flag, placeholder, with_default(field, names.at(current)));
  argument.choices = names;
  argument.set = [flag, names, assign](const std::string& text) { assign(parse_choice(flag, text, names)); };
}

template void FieldDeclarer::number(const Field&, int&, const Range&) const;
template void FieldDeclarer::number(const Field&, double&, const Range&) const;
template void FieldDeclarer::number(const Field&, std::uint64_t&, const Range&) const;

}  // namespace motex::cli
