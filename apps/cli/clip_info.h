// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "motex/motion_io/read_options.h"
#include "session.h"

namespace motex::cli {

/// Whether the file is named or begins like a clip or markers rather than a model.
bool is_motion_file(const std::string& path);

/// Length, rate, unit and joints of a clip, or markers and what is missing of them; list: a line a joint or marker.
void report_motion_file(const std::string& path, bool list, Session& session);

}  // namespace motex::cli
