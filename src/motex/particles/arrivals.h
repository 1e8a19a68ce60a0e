// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "motex/core/rng.h"

namespace motex {

/// When things arrive: arrival j at a random time of [j, j + 1) / rate. Steadier than a Poisson process, whose counts
/// would scatter by √n. Any frame can be asked for, also negative ones, without the frames before it. With a period of
/// N frames arrivals repeat every N frames exactly: what makes loops.
class Arrivals {
 public:
  /// rate ≥ 0 a frame. period: frames; 0 = none; with one, the rate becomes a whole number a period, at least one
  /// unless it is 0.
  Arrivals(double rate, std::int64_t period, const Rng& rng);
  /// Calls take(number, rng) for each arrival of the frame; number is the same and rng in the same state in every
  /// period.
  void at(std::int64_t frame, const std::function<void(std::int64_t number, Rng& rng)>& take) const;

 private:
  double rate_;
  std::int64_t period_, num_in_period_;
  Rng rng_;
};

/// Draws from weighted items so that every round of as many draws as items takes each about as often as its weight
/// says: stratified, in random order. draw(n) is the n-th draw, whatever was drawn before.
class WeightedDeck {
 public:
  WeightedDeck(std::vector<double> weights, const Rng& rng);
  bool empty() const { return cumulative_.empty(); }
  std::size_t draw(std::int64_t n);

 private:
  std::vector<double> cumulative_;
  Rng rng_;
  std::int64_t round_ = -1;
  bool has_round_ = false;
  std::vector<std::size_t> order_;  // of the strata in this round
};

}  // namespace motex
