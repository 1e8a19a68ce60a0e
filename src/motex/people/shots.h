// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "motex/image/image.h"
#include "motex/people/motif.h"

namespace motex {

struct PictureSize {
  int width = 0, height = 0;
};

/// Where footage was cut.
struct ShotReport {
  std::vector<FrameSpan> shots;    ///< unbroken views, one after another, all frames
  std::vector<FrameSpan> flashes;  ///< lighter or darker than the half second on either side: no reason for a cut
};

/// Finds hard cuts frame by frame, also those between two views of one actor before one background.
///
/// Every frame is shrunk to about 5,000 pixels. What of a frame lies outside the range of the other's 3 × 3 (5 × 5)
/// neighbours, 3 grey levels spared, averaged over pixels and the larger of both ways, is what motion of one (two) such
/// pixels cannot explain: r₁, r₂ from one frame to the next, m₁, m₂ the largest over *two* frames among the three
/// before and the three after, since cameras lose frames. A cut is where
///   r₁ / (m₁ + 0.1) + r₂ / (m₂ + 0.1) ≥ 3.
/// Frames whose mean light differs by 12 levels from the median of half a second on either side are flashes: the frames
/// before and after are compared instead, with what moved before in as long a time. Cost: about 0.5 ms a frame of
/// 720 × 480; memory: half a second of small frames.
class ShotFinder {
 public:
  explicit ShotFinder(double frames_per_sec);
  /// What frames of that size are shrunk to; frames that come in that size already are taken as they are.
  static PictureSize small_size(int width, int height);
  /// The next frame; all have one size. Throws InvalidInput for another.
  void add(const Image& frame);
  /// After the last frame; one shot when there is one.
  ShotReport finish();

 private:
  using Levels = std::vector<std::uint8_t>;  ///< planes R, G, B
  struct SmallFrame {
    Levels values;
    Levels lows_one, highs_one, lows_two, highs_two;  ///< smallest and largest of 3 × 3 and 5 × 5 neighbours
    double mean = 0;
  };
  struct Change {
    int frame = 0;  ///< from the one before that is no flash
    double one = 0, two = 0;
    double usual_one = 0, usual_two = 0;  ///< up to the frame before this one, over twice that time
  };
  SmallFrame shrink(const Image& frame) const;
  void classify_oldest();
  void compare(const SmallFrame& frame);
  double score(std::size_t idx) const;

  int reach_;  ///< frames of half a second
  int width_ = 0, height_ = 0, small_width_ = 0, small_height_ = 0;
  int num_frames_ = 0, next_ = 0;   ///< seen; the first not yet classified
  std::deque<SmallFrame> waiting_;  ///< from next_ on
  std::deque<double> means_;        ///< of frames next_ − reach_ … num_frames_ − 1
  std::deque<SmallFrame> past_;     ///< the last ones that were no flashes
  std::vector<Change> changes_;
  std::vector<FrameSpan> flashes_;
};

}  // namespace motex
