// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "motex/core/options.h"

namespace motex::cli {

/// One flag or positional argument of a command. Values are text until `set` puts them where they belong.
struct Argument {
  std::string section;               ///< heading of the help page under which it stands
  std::string flag;                  ///< "--output"; empty for a positional argument
  std::string short_flag;            ///< "-o" or empty
  std::string negation;              ///< "--no-foot-fix" or empty; gives a switch the value "false"
  std::string placeholder;           ///< "MODEL"; empty for a switch, whose value is "true"
  std::string help;                  ///< with unit and default
  std::vector<std::string> choices;  ///< the values there are, where they can be listed
  bool required = false;
  bool greedy = false;  ///< takes all values up to the next flag
  /// Called once a value, in the order given. Throws InvalidInput naming the argument.
  std::function<void(const std::string& value)> set;
};

/// Flag that a field of an options struct gets: "foot_fix" → "--foot-fix".
std::string flag_name(const std::string& field_name);

/// Text to field. Throws InvalidInput: "--fps: '3o' is not a number".
void parse_value(const std::string& argument, const std::string& text, double& value);
void parse_value(const std::string& argument, const std::string& text, int& value);
void parse_value(const std::string& argument, const std::string& text, std::int64_t& value);
void parse_value(const std::string& argument, const std::string& text, std::uint64_t& value);
void parse_value(const std::string& argument, const std::string& text, std::string& value);
std::size_t parse_choice(const std::string& argument, const std::string& text, const std::vector<std::string>& choices);

/// "3,17,5" → its words; none for "".
std::vector<std::string> split_at_commas(const std::string& text);

/// What a command takes, declared once; parsing, help page and completion are made from it.
class Arguments {
 public:
  /// Heading of the arguments that follow.
  void section(std::string heading) { section_ = std::move(heading); }

  template <typename T>
  Argument& positional(const std::string& placeholder, const std::string& help, T& target) {
    Argument& argument = add("", placeholder, help, target);
    argument.required = true;
    return argument;
  }
  /// flags: "--output" or "-o,--output". A std::vector target collects a value from each time that the flag is given.
  template <typename T>
  Argument& value(const std::string& flags, const std::string& placeholder, const std::string& help, T& target) {
    return add(flags, placeholder, help, target);
  }
  Argument& toggle(const std::string& flags, const std::string& help, bool& target);

  /// One flag for every field of an options struct (core/options.h).
  template <typename Options>
  void options(Options& options);

  const std::vector<Argument>& all() const { return arguments_; }
  bool has(const std::string& flag) const;

 private:
  friend struct FieldDeclarer;
  Argument& append(const std::string& flags, const std::string& placeholder, const std::string& help);

  template <typename T>
  Argument& add(const std::string& flags, const std::string& placeholder, const std::string& help, T& target) {
    Argument& argument = append(flags, placeholder, help);
    const std::string name = argument.flag.empty() ? placeholder : argument.flag;
    argument.set = [name, &target](const std::string& text) { parse_value(name, text, target); };
    return argument;
  }
  template <typename T>
  Argument& add(const std::string& flags, const std::string& placeholder, const std::string& help,
                std::vector<T>& target) {
    Argument& argument = append(flags, placeholder, help);
    const std::string name = argument.flag.empty() ? placeholder : argument.flag;
    argument.greedy = argument.flag.empty();
    argument.set = [name, &target](const std::string& text) { parse_value(name, text, target.emplace_back()); };
    return argument;
  }

  std::vector<Argument> arguments_;
  std::string section_;
};

/// The visitor that turns fields into flags.
struct FieldDeclarer {
  Arguments& arguments;

  void operator()(const Field& field, bool& value, const Range&) const;
  void operator()(const Field& field, int& value, const Range& range) const { number(field, value, range); }
  void operator()(const Field& field, double& value, const Range& range) const { number(field, value, range); }
  void operator()(const Field& field, std::uint64_t& value, const Range& range) const { number(field, value, range); }
  void operator()(const Field& field, std::string& value, const Range&) const;
  template <typename Enum>
  void operator()(const Field& field, Enum& value, const Choices& choices) const {
    static_assert(std::is_enum_v<Enum>);
    declare_choice(field, static_cast<std::size_t>(value), choices.names,
                   [&value](std::size_t idx) { value = static_cast<Enum>(idx); });
  }

 private:
  template <typename T>
  void number(const Field& field, T& value, const Range& range) const;
  void declare_choice(const Field& field, std::size_t current, const std::vector<std::string>& names,
                      const std::function<void(std::size_t)>& assign) const;
};

template <typename Options>
void Arguments::options(Options& options) {
  Options::visit_fields(options, FieldDeclarer{*this});
}

}  // namespace motex::cli
