// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "command.h"

namespace motex::cli {

/// Help page of one command. arguments: its own and the common ones.
std::string help_page(const Command& command, const Arguments& arguments);
/// The commands whose names begin with `noun` ("" = all).
std::string help_overview(const CommandTable& table, const std::string& noun);
/// Bash completion for every command, its flags and their choices.
std::string bash_completion(const CommandTable& table);

/// What a command takes: its own arguments and the common ones.
Arguments arguments_of(const Command& command, CommonFlags& flags);

}  // namespace motex::cli
