// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "motex/core/lowered.h"

namespace motex {

/// ".bvh" of "a/B.BVH"; empty where there is none.
inline std::string extension_of(const std::filesystem::path& path) { return lowered(path.extension().string()); }

}  // namespace motex
