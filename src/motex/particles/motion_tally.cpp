// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/motion_tally.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace motex {

MotionTally::Bins MotionTally::bins_of(double vx, double vy) const {
  const auto bin = [](double share) {
    return static_cast<std::uint8_t>(std::clamp(share * static_cast<double>(kBins), 0.0, kBins - 1.0));
  };
  return {bin(std::hypot(vx, vy) / top_speed_), bin(std::atan2(vy, vx) / (2 * std::numbers::pi) + 0.5)};
}

void MotionTally::add(const MotionTally& other, double times) {
  frames_ += times * other.frames_;
  elements_ += times * other.elements_;
  for (std::size_t k = 0; k < kBins; ++k) {
    speeds_[k] += times * other.speeds_[k];
    directions_[k] += times * other.directions_[k];
  }
}

MotionTally::Difference MotionTally::difference(const MotionTally& wanted) const {
  const double others = std::max(wanted.elements_, 1e-9);
  const double own_share = 1 / std::max(elements_, 1e-9), wanted_share = 1 / others;
  Difference apart;
  for (std::size_t k = 0; k < kBins; ++k) {
    apart.speed += std::abs(speeds_[k] * own_share - wanted.speeds_[k] * wanted_share) / 2;
    apart.direction += std::abs(directions_[k] * own_share - wanted.directions_[k] * wanted_share) / 2;
  }
  apart.count = elements_ / std::max(frames_, 1e-9) * std::max(wanted.frames_, 1e-9) / others - 1;
  return apart;
}

}  // namespace motex
