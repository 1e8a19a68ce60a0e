// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/image/image.h"

namespace motex {

class FrameSink;

struct WriteVideoOptions {
  double frames_per_sec = 25;  ///< for frames that are written without a time, and what the header says
  bool alpha = false;          ///< keep alpha: .mov, .webm, .mkv, pictures; elsewhere InvalidInput
  /// .mp4: for frames that are picked out again and worked on: a key frame every 15 frames, the smallest error rather
  /// than the best look, finer quality (crf 10).
  bool for_storage = false;
  double pixel_aspect = 1;  ///< width of a pixel / its height, for players; pictures have no place for it
};

/// Writes a video frame by frame. The file appears under its name when finish() returns, and never otherwise.
///
/// | name | as |
/// | --- | --- |
/// | .mp4 | H.264, 4:2:0, near-transparent quality; odd sizes 4:4:4, because 4:2:0 has none |
/// | .webm | VP9; with alpha |
/// | .mov | ProRes 4444, 10 bits; with alpha |
/// | .mkv | FFV1: every pixel exactly; with alpha |
/// | .avi | Motion JPEG 4:4:4; one frame rate only |
/// | a folder, f_%04d.png | PNG files, numbered from 0; with alpha |
///
/// Colours are BT.709, studio range, and marked so (AVI: JPEG's own). Times are kept to 1/90000 s (.mkv, .webm:
/// 1/1000). The same frames give the same bytes on one machine.
class VideoWriter {
 public:
  /// Throws InvalidInput: unknown extension, alpha where there is none, sizes outside 1 … 16384 (MP4: from 2).
  VideoWriter(const std::filesystem::path& path, int width, int height, const WriteVideoOptions& options = {},
              const JobContext& job = {});
  /// A file in memory: `bytes` holds it after finish() and must live until then. extension: ".mp4", …, no pictures.
  static VideoWriter to_bytes(std::string& bytes, const std::string& extension, int width, int height,
                              const WriteVideoOptions& options = {}, const JobContext& job = {});
  ~VideoWriter();
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;

  /// Frame number n at n / frames_per_sec. Throws InvalidInput for another size, WriteError (disk full), Cancelled.
  void write(const Image& image);
  /// At that time; times begin at 0 or later and rise by at least 1/1000 s.
  void write(const Image& image, double time_secs);
  /// Completes the file and gives it its name. Throws InvalidInput when no frame was written.
  void finish();

 private:
  VideoWriter(std::unique_ptr<FrameSink> sink, int width, int height, double frames_per_sec, const JobContext& job);
  std::unique_ptr<FrameSink> sink_;
  int width_, height_;
  double frames_per_sec_, last_secs_ = -1;
  std::int64_t num_frames_ = 0;
  JobContext job_;
};

/// Extensions that VideoWriter knows: ".mp4", ….
std::vector<std::string> writable_video_extensions();
/// Those that the libav here cannot write, with the encoder that it lacks: ".mp4 (libx264)"; none in a usual one.
std::vector<std::string> missing_video_encoders();
/// Version of the libav that is linked, for `motex doctor`.
std::string libav_release();
/// Whether a file of that extension can keep alpha.
bool keeps_alpha(const std::string& extension);

}  // namespace motex
