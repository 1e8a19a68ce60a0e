// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "motex/core/job.h"

namespace motex {

/// Whether the path stands for several pictures: a folder, or a name with %d, %04d or *.
bool is_picture_sequence(const std::filesystem::path& path);

/// The pictures of a folder or pattern in the order of the last number in their names, then by name. Numbers that are
/// missing between them are warned of. Throws InvalidInput when there are none.
std::vector<std::filesystem::path> list_pictures(const std::filesystem::path& path, const JobContext& job);

}  // namespace motex
