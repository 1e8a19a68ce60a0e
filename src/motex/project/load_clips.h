// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "motex/core/job.h"
#include "motex/motion/clip.h"
#include "motex/motion_io/read_options.h"

namespace motex {

/// The files, with each folder replaced by the readable clips in it, sorted by name (folders inside it are left alone).
/// Throws InvalidInput for a folder without any.
std::vector<std::filesystem::path> find_clip_files(const std::vector<std::filesystem::path>& paths);

/// Reads all clips and gives them one skeleton and one frame rate (unify_clips), in the order of find_clip_files. The
/// error of the first file that cannot be read is thrown.
std::vector<Clip> load_clips(const std::vector<std::filesystem::path>& paths, const ReadClipOptions& options = {},
                             const JobContext& job = {});

}  // namespace motex
