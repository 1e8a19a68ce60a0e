// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "command.h"

namespace motex::cli {

/// docs/reference_options.md: every command with its arguments, made from what the commands declare. Printed by
/// `motex help --reference`.
std::string reference_markdown(const CommandTable& table);

}  // namespace motex::cli
