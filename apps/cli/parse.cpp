// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "parse.h"

#include <CLI/CLI.hpp>

#include "closest.h"
#include "motex/core/error.h"

namespace motex::cli {
namespace {

std::string cli11_names(const Argument& argument) {
  if (argument.flag.empty()) return argument.placeholder;
  std::string names = argument.flag;
  if (!argument.short_flag.empty()) names += "," + argument.short_flag;
  if (argument.placeholder.empty()) names = argument.flag + "{true}";
  if (!argument.short_flag.empty() && argument.placeholder.empty()) names += "," + argument.short_flag + "{true}";
  if (!argument.negation.empty()) names += "," + argument.negation + "{false}";
  return names;
}

CLI::Option* declare(CLI::App& app, const Argument& argument, std::string& switch_value) {
  if (argument.placeholder.empty())
    return app.add_flag(cli11_names(argument), switch_value)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  CLI::Option* option = app.add_option(cli11_names(argument), [](const CLI::results_t&) { return true; });
  option->type_size(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  if (argument.greedy) option->expected(1, CLI::detail::expected_max_vector_size)->allow_extra_args();
  return option;
}

void check_unknown(const std::vector<std::string>& extras, const Arguments& arguments) {
  if (extras.empty()) return;
  std::vector<std::string> known;
  for (const Argument& argument : arguments.all()) {
    if (!argument.flag.empty()) known.push_back(argument.flag);
    if (!argument.negation.empty()) known.push_back(argument.negation);
  }
  for (const std::string& word : extras)
    if (word.size() > 1 && word[0] == '-')
      throw InvalidInput("unknown flag " + word + did_you_mean(word.substr(0, word.find('=')), known));
  throw InvalidInput("one argument too many: '" + extras.front() + "'");
}

void check_missing(const std::vector<CLI::Option*>& options, const Arguments& arguments) {
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < options.size(); ++i) {
    const Argument& argument = arguments.all()[i];
    if (!argument.required || options[i]->count() > 0) continue;
    const std::string& flag = argument.short_flag.empty() ? argument.flag : argument.short_flag;
    missing.push_back(flag.empty() ? argument.placeholder : flag + " " + argument.placeholder);
  }
  if (!missing.empty()) throw InvalidInput(enumerate(missing) + " missing; see --help");
}

}  // namespace

void parse(const std::vector<std::string>& words, const Arguments& arguments) {
  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  std::vector<std::string> switch_values(arguments.all().size());
  std::vector<CLI::Option*> options;
  for (const Argument& argument : arguments.all())
    options.push_back(declare(app, argument, switch_values[options.size()]));
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError& error) {
    throw InvalidInput(error.what());
  }
  check_unknown(app.remaining(), arguments);
  check_missing(options, arguments);
  for (std::size_t i = 0; i < options.size(); ++i) {
    if (options[i]->count() == 0) continue;
    const Argument& argument = arguments.all()[i];
    if (argument.placeholder.empty())
      argument.set(switch_values[i]);
    else
      for (const std::string& value : options[i]->results()) argument.set(value);
  }
}

}  // namespace motex::cli
