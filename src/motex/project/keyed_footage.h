// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "motex/core/job.h"
#include "motex/image/mask.h"
#include "motex/people/clean_plate.h"
#include "motex/people/key.h"
#include "motex/people/motif.h"
#include "motex/people/sprite.h"
#include "motex/video_io/video_reader.h"

namespace motex {

struct KeyFootageOptions {
  CleanPlateOptions plate;
  KeyOptions key;
  std::filesystem::path plate_picture;  ///< of the empty scene; empty = estimated from the footage
  std::filesystem::path
      garbage_mask;  ///< bright (or opaque, where the picture has alpha) = never the actor; empty = none
  FrameSpan frames;  ///< of the video; length 0 = all
};

struct KeyedFrame {
  Sprite sprite;
  std::int64_t idx = 0;
  double time_secs = 0;
};

/// What was seen while keying.
struct KeyFootageReport {
  std::int64_t num_frames = 0;
  std::int64_t num_empty = 0;    ///< frames in which nobody is
  std::int64_t num_crowded = 0;  ///< frames in which more than half of the border is covered: the scene changed
  std::int64_t first_crowded = -1;
  double mean_area = 0;  ///< of alpha, share of the frame
};

/// A video keyed frame by frame in two passes: the first reads up to 48 frames spread over it for the clean plate, the
/// second gives the frames in order; several are keyed at a time, with the same result for any number of threads.
/// Footage that has alpha already is taken as it is.
///
///   KeyedFootage footage("take1.mp4", {}, job);
///   for (KeyedFrame frame; footage.next(frame);) use(frame.sprite);
class KeyedFootage {
 public:
  /// Reads the plate's frames. Throws InvalidInput (nothing to key by, a moving camera, a plate or mask of another
  /// size) naming the file, and what VideoReader throws.
  explicit KeyedFootage(const std::filesystem::path& video, const KeyFootageOptions& options = {},
                        const JobContext& job = {});

  const VideoInfo& info() const { return reader_.info(); }
  std::int64_t num_frames() const { return num_frames_; }
  /// Nothing where the footage has alpha of its own.
  const CleanPlate* plate() const { return keyers_.empty() ? nullptr : &keyers_[0].plate(); }
  /// The next frame; false after the last.
  bool next(KeyedFrame& frame);
  const KeyFootageReport& report() const { return report_; }

 private:
  void prepare(const std::filesystem::path& video, const KeyFootageOptions& options, const JobContext& job);
  void read_batch();
  void take_notes(const KeyedFrame& frame);

  VideoReader reader_;
  JobContext job_;
  std::int64_t num_frames_ = 0, num_read_ = 0;
  std::vector<Keyer> keyers_;  // one for each frame of a batch
  std::vector<VideoFrame> pictures_;
  std::vector<KeyedFrame> keyed_;
  std::size_t num_ready_ = 0, next_ = 0;
  KeyFootageReport report_;
};

/// The picture as a garbage mask: what is opaque where it has alpha, else what is brighter than half.
Mask garbage_mask_of(const Image& picture);

}  // namespace motex
