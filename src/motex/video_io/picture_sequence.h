// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/video_io/frame_source.h"

namespace motex {

/// Pictures in files, one at a time in memory. Each must have the size of the first (InvalidInput names the one that
/// has not); a picture that cannot be read ends the sequence with a warning.
class PictureSequence : public FrameSource {
 public:
  PictureSequence(std::vector<std::filesystem::path> pictures, const std::string& name, double frames_per_sec,
                  const JobContext& job);
  const VideoInfo& info() const override { return info_; }
  bool advance() override;
  double time_secs() const override { return static_cast<double>(idx_) / info_.frames_per_sec; }
  std::int64_t idx() const override { return idx_; }
  void to_image(Image& image) const override { image = to_image_; }
  void to_planes(Planes& planes) const override { planes = to_planes_; }
  void seek(std::int64_t idx) override { idx_ = idx - 1; }
  std::vector<double> frame_times() override;

 private:
  std::vector<std::filesystem::path> pictures_;
  JobContext job_;
  VideoInfo info_;
  std::int64_t idx_ = -1;
  Image to_image_;
  Planes to_planes_;
};

}  // namespace motex
