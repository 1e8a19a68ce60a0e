// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/chance_rate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace motex {
namespace {

/// Performances never agree better: where frames fall between moments already makes such differences.
constexpr double kFinest = 2e-3;

/// Closeness whose tail is exponential: −ln(1 − ρ²).
double closeness(double correlation) { return -std::log(std::max(kFinest, 1 - correlation * correlation)); }

}  // namespace

double log_poisson_tail(double lambda, int c) {
  if (c <= 0) return 0;
  if (lambda <= 0) return -1e9;
  if (lambda > c) {  // not in the tail
    return -1e-3;
  }
  double term = c * std::log(lambda) - lambda - std::lgamma(c + 1.0), sum = 1, ratio = 1;
  for (int k = c + 1; k < c + 1000; ++k) {
    ratio *= lambda / k;
    sum += ratio;
    if (ratio < 1e-12 * sum) break;
  }
  return term + std::log(sum);
}

ChanceRate::ChanceRate(const std::vector<Match>& matches, int num_frames) : num_frames_(num_frames) {
  for (const Match& match : matches) closeness_.push_back(closeness(match.correlation));
  constexpr std::size_t kTail = 24;
  if (closeness_.size() < 4) return;
  const std::size_t count = std::min(kTail, closeness_.size() - 1);
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) sum += closeness_[k] - closeness_[count];
  tail_ = static_cast<double>(count);
  from_ = closeness_[count];
  mean_excess_ = std::max(1e-6, sum / tail_) * (1 + 1 / std::sqrt(tail_));  // an error bar to the safe side
}

double ChanceRate::operator()(double correlation) const {
  const double z = closeness(correlation);
  if (tail_ == 0) return (static_cast<double>(closeness_.size()) + 1) / num_frames_ * std::exp(-2 * z);
  if (z >= from_) return tail_ / num_frames_ * std::exp(-(z - from_) / mean_excess_);
  const auto above = std::partition_point(closeness_.begin(), closeness_.end(), [z](double v) { return v >= z; });
  return static_cast<double>(above - closeness_.begin()) / num_frames_;
}

ChanceRates::ChanceRates(const std::vector<PatternSearch>& backgrounds, const Pattern& pattern) {
  constexpr double kLeast = 0.2;  // correlation: enough for the tail
  for (const PatternSearch& background : backgrounds)
    rates_.emplace_back(background.matches(pattern, kLeast), background.num_frames());
}

double ChanceRates::operator()(double correlation) const {
  double most = 0;
  for (const ChanceRate& rate_of : rates_) most = std::max(most, rate_of(correlation));
  return most;
}

}  // namespace motex
