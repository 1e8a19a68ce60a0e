// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "arguments.h"

namespace motex::cli {

/// Hands each value on the command line to its argument. Throws InvalidInput: unknown flags come first, with what was
/// probably meant, then missing arguments, then values that do not fit.
void parse(const std::vector<std::string>& words, const Arguments& arguments);

}  // namespace motex::cli
