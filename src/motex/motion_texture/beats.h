// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "motex/core/options.h"
#include "motex/motion_texture/synthesize.h"

namespace motex {

/// When examples end so that the next ones begin on beats. An example of n frames that begins at frame p and gives way
/// to the next one at frame q costs (log((q − p)/n) / log(1 + stretch))²; q is a beat, or at a cost of 6 another moment
/// where beats are more than a second apart. The cost to go,
///
///   W(a, p) = min_q [cost(a, p, q) + 0.9 min_{b follows a} W(b, q)],
///
/// is found backwards from the last beat, where it is 0. O(beats · examples · followers).
class BeatGrid {
 public:
  /// beat_secs: moments in seconds from the first frame on. followers: by example, what can come after it.
  /// Throws InvalidInput unless there is a beat and beats rise, are finite and not negative, at most 20,000.
  BeatGrid(const MotionTexture& model, std::span<const double> beat_secs, double stretch,
           std::vector<std::vector<int>> followers);

  /// Frame at which the example after `instance`, which begins at frame `start`, should begin.
  Index end_of(int instance, Index start) const;
  /// W. 0 after the last beat.
  double cost(int instance, Index start) const;

 private:
  struct Choice {
    double cost = 0;
    Index end = 0;
  };
  Choice choose(int instance, Index start) const;
  void place_moments(std::span<const double> beat_secs);

  double log_stretch_;
  double frame_time_secs_;
  std::vector<Index> lengths_;  ///< by example: frames up to where the next one begins
  std::vector<std::vector<int>> followers_;
  std::vector<Index> moments_;              ///< frames at which examples may begin
  std::vector<double> penalties_;           ///< by moment
  std::vector<std::vector<double>> to_go_;  ///< by moment and example: 0.9 min over followers of W
};

/// How well the textons of a dance begin on beats.
struct BeatReport {
  int num_boundaries = 0;    ///< beginnings after frame 0 and not after the last beat
  double median_offset = 0;  ///< frames to the nearest beat
  double largest_offset = 0;
  double share_on_beat = 0;   ///< within one frame
  double median_stretch = 1;  ///< of log lengths against the examples' own, as a factor ≥ 1
};
BeatReport report_beats(const MotionTexture& model, std::span<const PlayedTexton> played,
                        std::span<const double> beat_secs);

}  // namespace motex
