// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace motex {

/// One coordinate along one cable or a piece of it: values one a frame.
struct CoordinateSeries {
  std::vector<double> values;
  bool from_birth = true;  ///< begins where the element was born
};

/// What is believed before any step is seen: `steps` steps with persistence φ and noise d.
struct DynamicsPrior {
  double steps = 4;
  double persistence = 0.7;
  double noise = 0.5;
  double smallest_noise = 0.01;
};

/// x_t = a₁ x_{t−1} + a₂ x_{t−2} + c_i + d n,  c_i = c + slope (x_first − start_mean) + rest,  rest ~ N(0, rest²)
struct AutoregressionFit {
  double lag1 = 0, lag2 = 0, constant = 0, noise = 1;
  double slope = 0, start_mean = 0, start_deviation = 0;
  double spread = 0;  ///< deviation of c_i over cables
};

/// Maximum likelihood with effects that differ from series to series. Given λ = rest²/d² it is generalised least
/// squares in closed form, because (I + λ 1 1ᵀ)⁻¹ = I − λ/(1 + nλ) 1 1ᵀ; λ itself by golden section. Conditioning c_i
/// on the beginning removes the bias of short series (Mundlak's device). order: 1 or 2 (lag2 = 0).
AutoregressionFit fit_random_effects(const std::vector<CoordinateSeries>& series, int order,
                                     const DynamicsPrior& prior);

}  // namespace motex
