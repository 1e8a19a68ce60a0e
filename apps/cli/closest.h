// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace motex::cli {

/// "; did you mean 'learn'?" for the candidate that fewest typing errors turn into `word`, "" when none is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

/// "a, b and c".
std::string enumerate(const std::vector<std::string>& words, const char* conjunction = "and");

}  // namespace motex::cli
