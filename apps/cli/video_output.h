// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "session.h"

namespace motex::cli {

/// To be called before long work, with the name of a video, a folder of pictures or a pattern (f_%04d.png): throws
/// InvalidInput when it cannot be written, or exists and --force was not given.
void check_video_output(const std::string& path, const Session& session);

}  // namespace motex::cli
