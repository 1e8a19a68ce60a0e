// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace motex {

/// xoshiro256** with our own distributions, so that a seed means the same numbers with every standard library.
/// Cheap to copy; a copy continues independently from the same place.
class Rng {
 public:
  explicit Rng(std::uint64_t seed);

  std::uint64_t next_u64();
  /// Uniform in [0, 1), 53 bits.
  double uniform();
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in 0 … n − 1 without bias. n ≥ 1.
  std::uint64_t below(std::uint64_t n);
  /// Standard normal (polar method).
  double normal();
  /// Index drawn with probability proportional to its weight. Throws InvalidInput unless weights are finite,
  /// non-negative and of positive sum.
  std::size_t weighted(std::span<const double> weights);
  /// A generator for sub-stream `stream`, independent of how much of this one was used after the fork.
  Rng fork(std::uint64_t stream) const;

 private:
  std::array<std::uint64_t, 4> state_;
  double spare_normal_ = 0;
  bool has_spare_ = false;
};

}  // namespace motex
