// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/people/template_match.h"

namespace motex {

/// ln P(X ≥ c), X ~ Poisson(λ); about 0 where λ > c.
double log_poisson_tail(double lambda, int c);

/// How often the background comes as close to a pattern, per frame: the empirical rate of its matches up to the 24
/// closest, an exponential tail in −ln(1 − ρ²) fitted to their excesses (plus one standard error) beyond.
class ChanceRate {
 public:
  /// matches: of the pattern in num_frames frames of background, the closest first.
  ChanceRate(const std::vector<Match>& matches, int num_frames);
  double operator()(double correlation) const;

 private:
  std::vector<double> closeness_;
  int num_frames_;
  double tail_ = 0, from_ = 0, mean_excess_ = 1;
};

/// The same of several backgrounds, the highest.
class ChanceRates {
 public:
  ChanceRates(const std::vector<PatternSearch>& backgrounds, const Pattern& pattern);
  double operator()(double correlation) const;

 private:
  std::vector<ChanceRate> rates_;
};

}  // namespace motex
