// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "arguments.h"
#include "session.h"

namespace motex::cli {

/// One command of the table in main.cpp.
struct Command {
  std::string name;      ///< "motion learn"
  std::string summary;   ///< one line
  std::string details;   ///< further sentences of the help page, or empty
  std::string examples;  ///< one a line
  /// Adds the command's own arguments, bound to a call that lives as long as the Command.
  std::function<void(Arguments&)> declare;
  std::function<void(Session&)> run;
};

struct CommandText {
  std::string name, summary, details, examples;
};

/// Call: a struct whose fields are the arguments, with declare(Arguments&) and run(Session&).
template <typename Call>
Command make_command(CommandText text) {
  const auto call = std::make_shared<Call>();
  return {std::move(text.name),
          std::move(text.summary),
          std::move(text.details),
          std::move(text.examples),
          [call](Arguments& arguments) { call->declare(arguments); },
          [call](Session& session) { call->run(session); }};
}

using CommandTable = std::vector<Command>;

}  // namespace motex::cli
