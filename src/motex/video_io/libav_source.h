// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "motex/core/job.h"
#include "motex/video_io/frame_pixels.h"
#include "motex/video_io/frame_source.h"
#include "motex/video_io/input_bytes.h"
#include "motex/video_io/libav_demuxer.h"

namespace motex::libav {

/// The best video stream of a container file.
class LibavSource : public FrameSource {
 public:
  /// Decodes the first frame. Throws UnsupportedFile when there is none.
  LibavSource(std::unique_ptr<InputBytes> input, const std::string& name, const JobContext& job);
  ~LibavSource() override;

  const VideoInfo& info() const override { return info_; }
  bool advance() override;
  double time_secs() const override { return time_secs_; }
  std::int64_t idx() const override { return idx_; }
  void to_image(Image& image) const override;
  void to_planes(Planes& planes) const override;
  void to_preview(Image& image, int width, int height) const override;
  void seek(std::int64_t idx) override;
  std::vector<double> frame_times() override;

 private:
  void open_codec();
  void restart();
  void describe();
  /// The next decoded frame; false at the end.
  bool decode();
  bool feed();
  void take_time();
  void finish();
  /// Reads times_ and key_times_.
  void scan_times();
  /// Whether frame `idx` lies ahead and no place to begin decoding at lies between.
  bool is_ahead(std::int64_t idx) const;
  /// Decodes up to frame `idx`, which is pending then; false where no frame has its time.
  bool decode_to(std::int64_t idx);

  std::unique_ptr<InputBytes> input_;
  JobContext job_;
  VideoInfo info_;
  std::optional<Demuxer> demuxer_;
  Handle<AVCodecContext> codec_;
  Handle<AVFrame> frame_;
  Handle<AVPacket> packet_;
  mutable PixelConverter converter_;
  mutable PixelConverter reducer_;  ///< for previews
  std::vector<double> times_;       ///< of all frames, once asked for
  std::vector<double> key_times_;   ///< of those at which decoding can begin; empty where that is not known
  bool has_pending_ = false;        ///< frame_ has been decoded and not yet handed out
  bool draining_ = false, has_ended_ = false, warned_ = false, warned_size_ = false;
  bool cut_off_ = false;  ///< reading the container ended with an error
  bool has_sought_ = false;
  std::int64_t num_damaged_ = 0;
  std::int64_t idx_ = -1;
  double time_secs_ = 0, first_secs_ = 0, longest_step_secs_ = 0;
};

}  // namespace motex::libav
