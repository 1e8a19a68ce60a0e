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
  std::int64_t period_, num_in_period_ = 0;
  Rng rng_;
};

/// Draws from weighted items so that any few draws in a row take items about as often as their weights say, and from
/// everywhere in the order in which they are given: draw(n) is the item at the share frac(offset + n (√5 − 1)/2) of the
/// weights (Kronecker's sequence).
class WeightedDeck {
 public:
  /// offset: from the generator.
  WeightedDeck(std::vector<double> weights, const Rng& rng);
  bool empty() const { return cumulative_.empty(); }
  std::size_t draw(std::int64_t n) const;
  /// The item at that share of the weights, 0 ≤ share < 1.
  std::size_t at_share(double share) const;

 private:
  std::vector<double> cumulative_;
  double offset_;
};

}  // namespace motex
