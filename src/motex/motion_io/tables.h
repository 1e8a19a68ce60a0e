// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "motex/motion/clip.h"

namespace motex {

/// A row a frame: frame (from 0), time in seconds, then joint.channel for every channel that write_bvh_bytes would
/// write (hip.Xposition in the clip's unit, hip.Zrotation in degrees, continued without jumps). Numbers have nine
/// significant digits, times are exact. Names with a comma, quote or line end stand in quotes (RFC 4180). Throws
/// InvalidInput as check_clip.
std::string write_csv_bytes(const Clip& clip);
void write_csv(const std::filesystem::path& path, const Clip& clip);

}  // namespace motex
