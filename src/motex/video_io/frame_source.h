// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/image/image.h"
#include "motex/image/planes.h"
#include "motex/video_io/video_info.h"

namespace motex {

/// One way in which frames are stored; VideoReader is the public face.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual const VideoInfo& info() const = 0;
  /// Moves to the next frame, the first one to begin with; false after the last. Throws Cancelled.
  virtual bool advance() = 0;
  /// Of the present frame.
  virtual double time_secs() const = 0;
  virtual std::int64_t idx() const = 0;
  virtual void to_image(Image& image) const = 0;
  virtual void to_planes(Planes& planes) const = 0;
  /// The present frame reduced to width × height by averaging, or larger where that costs no less.
  virtual void to_preview(Image& image, int width, int height) const;
  /// The next advance() gives frame `idx`, or false when there are fewer.
  virtual void seek(std::int64_t idx) = 0;
  /// Times of all frames; what it costs is reading the file, decoding only where time stamps are missing.
  virtual std::vector<double> frame_times() = 0;
};

inline void FrameSource::to_preview(Image& image, int, int) const { to_image(image); }

}  // namespace motex
