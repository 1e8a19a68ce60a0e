// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace motex {

/// How many elements there are, and how fast and where they go: what a synthesis is to share with its clip.
class MotionTally {
 public:
  /// Total variation of speed and of direction; elements a frame over those wanted, less one.
  struct Difference {
    double speed = 0, direction = 0, count = 0;
  };

  /// Histograms of 24 bins: speeds to top_speed, directions in steps of 15°.
  explicit MotionTally(double top_speed = 1) : top_speed_(top_speed) {}

  /// Where in the histograms an element is.
  struct Bins {
    std::uint8_t speed = 0, direction = 0;
  };
  Bins bins_of(double vx, double vy) const;
  void add(Bins bins, double times = 1) {
    speeds_[bins.speed] += times;
    directions_[bins.direction] += times;
    elements_ += times;
  }

  double top_speed() const { return top_speed_; }
  void add_element(double vx, double vy) { add(bins_of(vx, vy)); }
  double num_elements() const { return elements_; }
  void add_frames(double num) { frames_ += num; }
  /// Adds so many times what the other has; −1 takes it away.
  void add(const MotionTally& other, double times = 1);
  Difference difference(const MotionTally& wanted) const;

 private:
  static constexpr std::size_t kBins = 24;
  double top_speed_;
  double frames_ = 0, elements_ = 0;
  std::array<double, kBins> speeds_{}, directions_{};
};

}  // namespace motex
