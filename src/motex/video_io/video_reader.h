// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "motex/core/job.h"
#include "motex/video_io/frame.h"
#include "motex/video_io/video_info.h"

namespace motex {

class FrameSource;

struct ReadVideoOptions {
  double frames_per_sec = 25;  ///< of pictures without times: folders, patterns, TIFF stacks
};

/// Reads a video frame by frame; only a few frames are in memory at a time.
///
/// A path is a video file (MP4, MOV, WebM, MKV, AVI, MPEG, Y4M, GIF, …), a folder of pictures (in the order of the
/// numbers in their names), a pattern ("f_%04d.png", "f_*.png"), one picture, or a multi-page TIFF stack. Rotation
/// asked for by the file is done; alpha is kept; frame times are the file's own (variable frame rates too) minus that
/// of the first frame.
///
///   VideoReader reader("snow.mp4", {}, job);
///   for (VideoFrame frame; reader.next(frame);) use(frame.image, frame.time_secs);
///
/// A file that is cut off or damaged gives the frames that can be read, and at its end a warning to the job. Throws
/// InvalidInput (missing), UnsupportedFile (no video in it, nothing readable: says why), Cancelled.
class VideoReader {
 public:
  explicit VideoReader(const std::filesystem::path& path, const ReadVideoOptions& options = {},
                       const JobContext& job = {});
  /// Of a file in memory, which must outlive the reader. name: for messages.
  static VideoReader from_bytes(std::string_view bytes, const std::string& name, const JobContext& job = {});
  ~VideoReader();
  VideoReader(VideoReader&&) noexcept;
  VideoReader& operator=(VideoReader&&) noexcept;

  const VideoInfo& info() const;
  /// The next frame; false after the last.
  bool next(VideoFrame& frame);
  bool next(DeepVideoFrame& frame);
  /// Moves to the next frame without its pixels; false after the last.
  bool advance();
  /// The frame moved to last.
  void read(VideoFrame& frame);
  /// The same reduced to width × height by averaging, at a small part of the cost; larger where that would not save any
  /// (pictures).
  void read_preview(Image& image, int width, int height);
  /// The next frame is number idx ≥ 0; next() is false when there are fewer. Decodes from the key frame before it,
  /// or reads on where there is none in between.
  void seek(std::int64_t idx);
  /// The next frame is the one shown at that time: the last whose time_secs is not later.
  void seek_secs(double time_secs);
  /// Times of all frames, the first 0. Reads the file through, but decodes only where time stamps are missing; the
  /// place of next() stays. A damaged file may have fewer frames that can be decoded.
  std::vector<double> frame_times();

 private:
  explicit VideoReader(std::unique_ptr<FrameSource> source);
  std::unique_ptr<FrameSource> source_;
};

/// Extensions that VideoReader knows, for help texts: ".mp4", ….
std::vector<std::string> readable_video_extensions();

/// Warns where pixels that are not square will be taken as square.
void warn_of_oblong_pixels(const VideoInfo& info, const JobContext& job);

}  // namespace motex
