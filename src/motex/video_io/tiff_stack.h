// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "motex/core/job.h"
#include "motex/video_io/frame_pixels.h"
#include "motex/video_io/frame_source.h"

namespace motex {

/// Where the directories of the pages of a TIFF file stand; none when the bytes are no TIFF file. At most 65535.
std::vector<std::uint32_t> find_tiff_pages(std::string_view bytes);

/// The pages of a TIFF file as frames. Memory: the file and one page. The decoder only knows first pages, so each page
/// is made the first in turn.
class TiffStack : public FrameSource {
 public:
  /// Throws UnsupportedFile when the first page cannot be decoded.
  TiffStack(std::string bytes, const std::string& name, double frames_per_sec, const JobContext& job);
  const VideoInfo& info() const override { return info_; }
  bool advance() override;
  double time_secs() const override { return static_cast<double>(idx_) / info_.frames_per_sec; }
  std::int64_t idx() const override { return idx_; }
  void to_image(Image& image) const override;
  void to_planes(Planes& planes) const override;
  void seek(std::int64_t idx) override { idx_ = idx - 1; }
  std::vector<double> frame_times() override;

 private:
  /// Leaves page idx in frame_. False when it cannot be decoded.
  bool decode(std::int64_t idx);
  std::string bytes_;
  JobContext job_;
  VideoInfo info_;
  bool big_endian_ = false;
  std::vector<std::uint32_t> pages_;
  libav::Handle<AVCodecContext> codec_;
  libav::Handle<AVFrame> frame_;
  libav::Handle<AVPacket> packet_;
  mutable libav::PixelConverter converter_;
  std::int64_t idx_ = -1;
};

}  // namespace motex
