// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "arguments.h"
#include "motex/motion/skeleton.h"
#include "session.h"

namespace motex::cli {

/// --skin FILE.glb.
void declare_skin(Arguments& arguments, std::string& skin_path);

/// Puts the file's skin on the skeleton; nothing for an empty path. Throws InvalidInput when it does not fit.
void put_on_skin(const std::string& skin_path, Skeleton& skeleton, Session& session);

}  // namespace motex::cli
