// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/video_outputs.h"

namespace motex {

namespace fs = std::filesystem;

bool writes_pictures(const fs::path& path) {
  return path.extension().empty() || path.filename().string().find('%') != std::string::npos;
}

VideoOutputs::VideoOutputs(const std::vector<fs::path>& paths, int width, int height, const WriteVideoOptions& options,
                           const JobContext& job) {
  for (const fs::path& path : paths) {
    const fs::path place = writes_pictures(path) ? path : staged_.stage(path);
    writers_.emplace_back(place, width, height, options, staged_.naming_targets(job));
  }
}

void VideoOutputs::write(const Image& image) {
  for (VideoWriter& writer : writers_) writer.write(image);
}

void VideoOutputs::write(const Image& image, double time_secs) {
  for (VideoWriter& writer : writers_) writer.write(image, time_secs);
}

void VideoOutputs::finish() {
  for (VideoWriter& writer : writers_) writer.finish();
  staged_.commit();
}

}  // namespace motex
