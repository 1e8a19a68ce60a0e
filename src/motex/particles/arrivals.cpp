// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/arrivals.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace motex {
namespace {

std::int64_t floor_divided(std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

}  // namespace

Arrivals::Arrivals(double rate, std::int64_t period, const Rng& rng) : rate_(rate), period_(period), rng_(rng) {
  if (period_ <= 0 || rate_ <= 0) return;
  num_in_period_ = std::max<std::int64_t>(1, std::llround(rate_ * static_cast<double>(period_)));
  rate_ = static_cast<double>(num_in_period_) / static_cast<double>(period_);
}

void Arrivals::at(std::int64_t frame, const std::function<void(std::int64_t, Rng&)>& take) const {
  if (rate_ <= 0) return;
  if (period_ > 0) frame -= period_ * floor_divided(frame, period_);
  const auto first = static_cast<std::int64_t>(std::floor(static_cast<double>(frame) * rate_)) - 1;
  const auto last = static_cast<std::int64_t>(std::ceil(static_cast<double>(frame + 1) * rate_)) + 1;
  for (std::int64_t number = first; number <= last; ++number) {
    if (period_ > 0 && (number < 0 || number >= num_in_period_)) continue;
    Rng own = rng_.fork(static_cast<std::uint64_t>(number));
    auto time = static_cast<std::int64_t>(std::floor((static_cast<double>(number) + own.uniform()) / rate_));
    if (period_ > 0) time = std::min(time, period_ - 1);
    if (time == frame) take(number, own);
  }
}

WeightedDeck::WeightedDeck(std::vector<double> weights, const Rng& rng)
    : cumulative_(std::move(weights)), offset_(Rng(rng).uniform()) {
  std::partial_sum(cumulative_.begin(), cumulative_.end(), cumulative_.begin());
  if (!cumulative_.empty() && !(cumulative_.back() > 0)) cumulative_.clear();
}

std::size_t WeightedDeck::draw(std::int64_t n) const {
  const double place = offset_ + static_cast<double>(n) * (std::numbers::phi - 1);
  return at_share(place - std::floor(place));
}

std::size_t WeightedDeck::at_share(double share) const {
  const double wanted = share * cumulative_.back();
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), wanted);
  return static_cast<std::size_t>(std::min(found, cumulative_.end() - 1) - cumulative_.begin());
}

}  // namespace motex
