// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/audio/fourier.h"

#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "motex/core/error.h"

namespace motex {

FourierTransform::FourierTransform(std::size_t n) : turns_(n / 2) {
  if (!std::has_single_bit(n)) throw InvalidInput("a Fourier transform takes a power of two of values");
  for (std::size_t k = 0; k < turns_.size(); ++k)
    turns_[k] = std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n));
}

void FourierTransform::operator()(std::vector<std::complex<double>>& values) const {
  const std::size_t n = values.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n >> 1;
    for (; (j & bit) != 0; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(values[i], values[j]);
  }
  for (std::size_t length = 2; length <= n; length *= 2)
    for (std::size_t start = 0; start < n; start += length)
      for (std::size_t k = 0; k < length / 2; ++k) {
        const std::complex<double> a = values[start + k], w = turns_[k * (n / length)],
                                   b = values[start + k + length / 2];
        const std::complex<double> turned(b.real() * w.real() - b.imag() * w.imag(),
                                          b.real() * w.imag() + b.imag() * w.real());
        values[start + k] = a + turned;
        values[start + k + length / 2] = a - turned;
      }
}

}  // namespace motex
