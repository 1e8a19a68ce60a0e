// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

namespace motex {

struct SimplexResult {
  std::vector<double> point;
  double value = 0;
  int num_evaluations = 0;
};

/// Smallest value of a function of few variables without derivatives (Nelder and Mead 1965): from `start` with edges
/// `step`, until values at the corners differ by less than `tolerance` or after max_evaluations.
SimplexResult minimise_by_simplex(const std::function<double(const std::vector<double>&)>& function,
                                  const std::vector<double>& start, double step, double tolerance, int max_evaluations);

}  // namespace motex
