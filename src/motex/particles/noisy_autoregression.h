// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/random_effects.h"

namespace motex {

/// x_t = μ + m_i + u_t,  u_t = φ u_{t−1} + d n,  m_i ~ N(0, spread²) of series i
struct NoisyAutoregressionFit {
  double persistence = 0;  ///< φ
  double noise = 1;        ///< d
  double mean = 0;         ///< μ
  double spread = 0;       ///< deviation of m
  double error = 0;        ///< deviation of a measurement
  double start_mean = 0;   ///< of x at the beginning
  double start_deviation = 0;
};

enum class MeasuredValue {
  kLevel,  ///< y_t = x_t + error
  kPlace   ///< y_t = z_t + error, z_t = z_{t−1} + x_t: x is the velocity
};

/// Maximum likelihood by a Kalman filter. All series share parameters and none has gaps, so gains and variances depend
/// on the age alone and are computed once; a series costs some ten operations a value. μ and the mean of u at the
/// beginning are eliminated by least squares; φ, d, spread and (error < 0: unknown) the error are found by the simplex
/// method from three persistences, best result kept. Prior as in fit_random_effects().
NoisyAutoregressionFit fit_noisy_autoregression(const std::vector<CoordinateSeries>& series, MeasuredValue kind,
                                                double error, const DynamicsPrior& prior);

}  // namespace motex
