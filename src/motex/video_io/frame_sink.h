// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "motex/core/job.h"
#include "motex/image/image.h"
#include "motex/video_io/video_writer.h"

namespace motex {

/// One way in which frames are stored; VideoWriter is the public face.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  virtual void write(const Image& image, double time_secs) = 0;
  virtual void finish() = 0;
};

struct SinkShape : WriteVideoOptions {
  int width = 0, height = 0;
};

std::unique_ptr<FrameSink> make_libav_sink(const std::filesystem::path& path, const SinkShape& shape,
                                           const JobContext& job);
/// Into memory: `bytes` is filled by finish() and must live until then. The extension of `name` decides the format.
std::unique_ptr<FrameSink> make_libav_sink(std::string& bytes, const std::string& name, const SinkShape& shape,
                                           const JobContext& job);
/// A folder or a pattern with %d; what was written is removed again unless it was finished.
std::unique_ptr<FrameSink> make_picture_sink(const std::filesystem::path& path, const SinkShape& shape);

}  // namespace motex
