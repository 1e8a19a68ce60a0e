// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace motex {

/// How many elements there are, and how fast and where they go: what a synthesis is to share with its clip.
class MotionTally {
 public:
  /// Histograms of 24 bins: speeds to top_speed, directions in steps of 15°.
  explicit MotionTally(double top_speed = 1) : top_speed_(top_speed) {}

  double top_speed() const { return top_speed_; }
  void add_element(double vx, double vy);
  void add_frames(double num) { frames_ += num; }
  void add(const MotionTally& other);
  /// Everything times so much: what was long ago counts less.
  void fade(double times);
  /// Total variation of speed and of direction, and the difference of the numbers of elements a frame over that of
  /// `wanted`.
  double distance(const MotionTally& wanted) const;

 private:
  static constexpr std::size_t kBins = 24;
  double top_speed_;
  double frames_ = 0, elements_ = 0;
  std::array<double, kBins> speeds_{}, directions_{};
};

}  // namespace motex
