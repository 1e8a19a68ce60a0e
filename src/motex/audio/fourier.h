// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <complex>
#include <vector>

namespace motex {

/// Discrete Fourier transform in place, X_k = Σ_t x_t e^{−2πi k t / n}.
class FourierTransform {
 public:
  /// Throws InvalidInput unless n is a power of two.
  explicit FourierTransform(std::size_t n);
  /// values: n.
  void operator()(std::vector<std::complex<double>>& values) const;

 private:
  std::vector<std::complex<double>> turns_;  ///< e^{−2πi k / n}, k < n/2
};

}  // namespace motex
