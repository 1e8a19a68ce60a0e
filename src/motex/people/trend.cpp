// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/trend.h"

#include <cmath>

namespace motex {
namespace {

constexpr double kStraight = 0.8;
constexpr double kBow = 0.96;

/// Share of the pattern that a straight line (degree 1) or a parabola (2) explains.
double explained_by_polynomial(const Pattern& pattern, int degree) {
  const auto m = static_cast<double>(pattern.rows());
  double sum = 0;
  for (Index s = 0; s < pattern.cols(); ++s) {
    double line = 0, bow = 0, line_norm = 0, bow_norm = 0;
    for (Index t = 0; t < pattern.rows(); ++t) {
      const double u = static_cast<double>(t) - (m - 1) / 2, v = u * u - (m * m - 1) / 12;
      line += u * pattern(t, s);
      bow += v * pattern(t, s);
      line_norm += u * u;
      bow_norm += v * v;
    }
    sum += line * line / line_norm + (degree > 1 ? bow * bow / bow_norm : 0);
  }
  return pattern.squaredNorm() > 0.5 ? sum : 1;
}

}  // namespace

bool is_drift(const Pattern& pattern) {
  return explained_by_polynomial(pattern, 1) > kStraight || explained_by_polynomial(pattern, 2) > kBow;
}

FrameMatrix without_line(const FrameMatrix& given) {
  FrameMatrix out = given;
  for (Index s = 0; s < given.cols(); ++s) {
    double count = 0, mean_t = 0, mean_x = 0, along = 0, spread = 0;
    for (Index t = 0; t < given.rows(); ++t) {
      if (!std::isfinite(given(t, s))) continue;
      count += 1;
      mean_t += (static_cast<double>(t) - mean_t) / count;
      mean_x += (given(t, s) - mean_x) / count;
    }
    for (Index t = 0; t < given.rows(); ++t) {
      if (!std::isfinite(given(t, s))) continue;
      const double u = static_cast<double>(t) - mean_t;
      along += u * (given(t, s) - mean_x);
      spread += u * u;
    }
    if (spread <= 0) continue;
    for (Index t = 0; t < given.rows(); ++t) out(t, s) -= mean_x + along / spread * (static_cast<double>(t) - mean_t);
  }
  return out;
}

}  // namespace motex
