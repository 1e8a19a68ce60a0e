// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "motex/core/extension.h"
#include "session.h"

namespace motex::cli {

/// To be called before long work: throws InvalidInput when the extension is none of the known ones (".bvh", …), the
/// file exists and --force was not given, or nothing can be written there.
void check_output(const std::string& path, const std::vector<std::string>& extensions, const Session& session);
/// The same for several, which must differ.
void check_outputs(const std::vector<std::string>& paths, const std::vector<std::string>& extensions,
                   const Session& session);

/// The result of --dry-run of a command that writes so many frames; −1: nobody knows yet.
void would_write(const std::vector<std::string>& paths, std::int64_t num_frames, Session& session);

}  // namespace motex::cli
