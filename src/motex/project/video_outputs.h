// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "motex/core/job.h"
#include "motex/project/staged_files.h"
#include "motex/video_io/video_writer.h"

namespace motex {

/// A folder or a pattern (f_%04d.png) of pictures rather than one file.
bool writes_pictures(const std::filesystem::path& path);

/// The same frames written to several videos, which appear together when all are finished, and never otherwise.
class VideoOutputs {
 public:
  /// Throws what VideoWriter throws.
  VideoOutputs(const std::vector<std::filesystem::path>& paths, int width, int height, const WriteVideoOptions& options,
               const JobContext& job);
  void write(const Image& image);
  void write(const Image& image, double time_secs);
  void finish();

 private:
  StagedFiles staged_;
  std::vector<VideoWriter> writers_;
};

}  // namespace motex
