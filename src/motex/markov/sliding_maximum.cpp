// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/markov/sliding_maximum.h"

#include <algorithm>
#include <limits>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();

// best = max(best, row) at `position`; plain arrays so that compilers vectorise it.
void take_larger(Index n, const double* __restrict row, std::int32_t position, double* __restrict best,
                 std::int32_t* __restrict best_position) {
  for (Index i = 0; i < n; ++i) {
    const bool larger = row[i] > best[i];
    best_position[i] = larger ? position : best_position[i];
    best[i] = larger ? row[i] : best[i];
  }
}

// out = max(a, b); a where they are equal.
void larger_of(Index n, const double* __restrict a, const std::int32_t* __restrict a_position,
               const double* __restrict b, const std::int32_t* __restrict b_position, double* __restrict out,
               std::int32_t* __restrict out_position) {
  for (Index i = 0; i < n; ++i) {
    const bool second = b[i] > a[i];
    out_position[i] = second ? b_position[i] : a_position[i];
    out[i] = second ? b[i] : a[i];
  }
}

}  // namespace

SlidingMaximum::SlidingMaximum(Index num_lanes, Index window) : num_lanes_(num_lanes), window_(window) {
  if (num_lanes < 0 || window < 0) throw InvalidInput("sliding maximum: sizes must not be negative");
  const auto n = static_cast<std::size_t>(num_lanes);
  values_.assign(n, kNone);
  positions_.assign(n, -1);
  first_counted_.assign(n, 0);
  if (window == 0) return;
  head_values_.assign(n, kNone);
  head_positions_.assign(n, -1);
  block_values_.assign(n * static_cast<std::size_t>(window), kNone);
  block_positions_.assign(n * static_cast<std::size_t>(window), -1);
}

void SlidingMaximum::push(const double* row) {
  if (window_ == 0) {
    take_larger(num_lanes_, row, num_pushed_, values_.data(), positions_.data());
  } else {
    push_windowed(row);
  }
  ++num_pushed_;
}

void SlidingMaximum::push_windowed(const double* row) {
  const Index offset = num_pushed_ % window_;
  const auto block_start = static_cast<std::int32_t>(num_pushed_ - offset);
  if (offset == 0) {
    std::fill(head_values_.begin(), head_values_.end(), kNone);
    std::fill(head_positions_.begin(), head_positions_.end(), -1);
  }
  std::copy(row, row + num_lanes_, &block_values_[static_cast<std::size_t>(offset * num_lanes_)]);
  take_larger(num_lanes_, row, num_pushed_, head_values_.data(), head_positions_.data());
  if (offset == window_ - 1) {
    values_ = head_values_;
    positions_ = head_positions_;
    make_suffix_maxima(block_start);
    return;
  }
  const auto tail = static_cast<std::size_t>((offset + 1) * num_lanes_);
  larger_of(num_lanes_, &block_values_[tail], &block_positions_[tail], head_values_.data(), head_positions_.data(),
            values_.data(), positions_.data());
}

void SlidingMaximum::make_suffix_maxima(std::int32_t block_start) {
  for (Index r = window_ - 1; r >= 0; --r) {
    const auto position = static_cast<std::int32_t>(block_start + r);
    double* values = &block_values_[static_cast<std::size_t>(r * num_lanes_)];
    std::int32_t* positions = &block_positions_[static_cast<std::size_t>(r * num_lanes_)];
    for (Index i = 0; i < num_lanes_; ++i) {
      const bool counts = position >= first_counted_[static_cast<std::size_t>(i)];
      values[i] = counts ? values[i] : kNone;
      positions[i] = counts ? position : -1;
    }
    if (r == window_ - 1) continue;
    for (Index i = 0; i < num_lanes_; ++i) {
      const bool later = values[i + num_lanes_] > values[i];
      positions[i] = later ? positions[i + num_lanes_] : positions[i];
      values[i] = later ? values[i + num_lanes_] : values[i];
    }
  }
}

void SlidingMaximum::forget(Index lane) {
  const auto i = static_cast<std::size_t>(lane);
  values_[i] = kNone;
  positions_[i] = -1;
  if (window_ == 0) return;
  head_values_[i] = kNone;
  head_positions_[i] = -1;
  first_counted_[i] = num_pushed_;
  // Tails of the last block; rows of this block are left out by first_counted_ when it ends.
  for (Index r = num_pushed_ % window_; r < window_; ++r) {
    block_values_[static_cast<std::size_t>(r * num_lanes_ + lane)] = kNone;
    block_positions_[static_cast<std::size_t>(r * num_lanes_ + lane)] = -1;
  }
}

}  // namespace motex
