// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "motex/core/job.h"
#include "motex/image/image.h"
#include "motex/video_io/video_reader.h"

namespace motex {

/// What stands behind an actor: a colour, a picture or a video that starts again at its end. Other sizes are cut to the
/// shape of the frame at their middle and scaled.
class Backdrop {
 public:
  Backdrop(Rgba colour, int width, int height);
  explicit Backdrop(const Image& picture) : width_(picture.width), height_(picture.height), image_(picture) {}
  /// A picture, or anything else that VideoReader reads. Throws what VideoReader throws.
  Backdrop(const std::filesystem::path& path, int width, int height, const JobContext& job = {});

  /// Frame `idx` ≥ 0, asked for in rising order; valid until the next call.
  const Image& frame(std::int64_t idx);

 private:
  bool read_next();
  int width_, height_;
  std::filesystem::path path_;
  JobContext job_;
  std::optional<VideoReader> reader_;
  Image image_;
  std::int64_t next_ = 0;
};

/// The picture cut to the shape of width × height at its middle and scaled to it.
Image fitted(const Image& picture, int width, int height);

}  // namespace motex
