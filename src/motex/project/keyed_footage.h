// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/image/mask.h"
#include "motex/people/clean_plate.h"
#include "motex/people/key.h"
#include "motex/people/motif.h"
#include "motex/people/sprite.h"
#include "motex/project/footage_scan.h"
#include "motex/video_io/video_reader.h"

namespace motex {

struct KeyFootageOptions {
  CleanPlateOptions plate;
  KeyOptions key;
  std::filesystem::path plate_picture;  ///< of the empty scene; empty = estimated from the footage
  std::filesystem::path
      garbage_mask;       ///< bright (or opaque, where the picture has alpha) = never the actor; empty = none
  FrameSpan frames;       ///< of the video; length 0 = all
  bool cuts = true;       ///< look for hard cuts; false = the footage is one shot
  int shortest_shot = 0;  ///< frames; shorter ones are passed over
};

struct KeyedFrame {
  Sprite sprite;
  std::int64_t idx = 0;
  double time_secs = 0;
  int shot = 0;
};

/// What was seen while keying.
struct KeyFootageReport {
  std::int64_t num_frames = 0;
  std::int64_t num_empty = 0;    ///< frames in which nobody is
  std::int64_t num_crowded = 0;  ///< frames in which more than half of the border is covered: the scene changed
  std::int64_t first_crowded = -1;
  double mean_area = 0;  ///< of alpha, share of the frame
};

/// A video keyed frame by frame in two passes: the first looks for hard cuts and takes frames for the clean plate as
/// they go by, the second gives the frames in order. Every scene of the scan has a plate of its own. Frames are keyed
/// several at a time, while the next ones are read, with the same result for any number of threads. Footage that has
/// alpha already is taken as it is.
///
///   KeyedFootage footage("take1.mp4", {}, job);
///   for (KeyedFrame frame; footage.next(frame);) use(frame.sprite);
class KeyedFootage {
 public:
  /// The first pass. Throws what VideoReader throws, and InvalidInput naming the file: nothing to key by, a moving
  /// camera, a plate or mask of another size. Where only some shots cannot be keyed that is a warning and they are
  /// empty; where none can, next() throws after the last.
  explicit KeyedFootage(const std::filesystem::path& video, const KeyFootageOptions& options = {},
                        const JobContext& job = {});
  KeyedFootage(const KeyedFootage&) = delete;
  KeyedFootage& operator=(const KeyedFootage&) = delete;

  const VideoInfo& info() const { return reader_.info(); }
  std::int64_t num_frames() const { return num_frames_; }
  /// Frames count as in the video.
  const ShotReport& shots() const { return scan_.report; }
  /// Of the first shot that has one; nothing where the footage has alpha of its own.
  const CleanPlate* plate() const { return first_plate_ ? &*first_plate_ : nullptr; }
  /// The next frame; false after the last, when it is said whether an actor before a natural scene stayed in one place.
  bool next(KeyedFrame& frame);
  const KeyFootageReport& report() const { return report_; }

 private:
  /// Frames on their way.
  struct Batch {
    std::vector<VideoFrame> pictures;
    std::size_t size = 0;
    int shot = 0;
  };
  CleanPlate plate_of_scene(int scene);
  void tell_of(const CleanPlate& plate, const std::vector<Image>& frames) const;
  void enter_scene(int scene);
  bool enter_next_shot();
  void fill(Batch& batch);
  void key_batch();
  void take_notes(const KeyedFrame& frame);
  void tell_of_place();

  std::filesystem::path video_;
  KeyFootageOptions options_;
  JobContext job_;
  VideoReader reader_;
  FootageScan scan_;
  Mask garbage_;
  Image plate_picture_;
  std::int64_t num_frames_ = 0;
  int shot_ = -1, scene_ = -1, rest_of_shot_ = 0;
  std::map<int, CleanPlate> plates_;  // of scenes that come back
  std::optional<CleanPlate> first_plate_;
  std::string trouble_;        // why there is no plate
  std::vector<Keyer> keyers_;  // one for each frame of a batch; none where the background is not known
  Batch now_, ahead_;
  std::vector<KeyedFrame> keyed_;
  std::size_t next_ = 0;
  KeyFootageReport report_;
  int left_ = std::numeric_limits<int>::max(), right_ = -1;  // first and last column where someone was seen
  std::vector<double> widths_;                               // of what was seen in each frame with someone, pixels
};

/// The picture as a garbage mask: what is opaque where it has alpha, else what is brighter than half.
Mask garbage_mask_of(const Image& picture);

}  // namespace motex
