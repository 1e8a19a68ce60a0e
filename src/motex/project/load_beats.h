// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "motex/core/job.h"

namespace motex {

/// Beats in seconds. A sound (.wav) is listened to (track_beats; the tempo found is said by job.warn); of any other
/// file the first number of each line counts. Lines that are empty or begin with # are skipped, and so is a first line
/// without a number (the heading of a table). Throws ParseError with the line, InvalidInput when there is no beat or
/// times do not rise.
std::vector<double> load_beats(const std::filesystem::path& path, const JobContext& job = {});
/// name: for messages.
std::vector<double> parse_beats(std::string_view text, const std::string& name);

}  // namespace motex
