// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/motif_code.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace motex {
namespace {

constexpr double kLeastResidual = 1e-3;
constexpr double kResolution = 0.02;  // of the largest deviation: what is below it is not told apart
constexpr double kPi = std::numbers::pi;

/// Sum of the products of the differences x(t + lag) − x(t) where both are known.
Matrix difference_products(const FrameMatrix& series, const std::vector<double>& level, Index lag) {
  Matrix sum = Matrix::Zero(series.cols(), series.cols());
  for (Index t = 0; t + lag < series.rows(); ++t) {
    if (level[static_cast<std::size_t>(t)] < 0 || level[static_cast<std::size_t>(t + lag)] < 0) continue;
    const Eigen::VectorXd step = (series.row(t + lag) - series.row(t)).transpose();
    if (step.allFinite()) sum += step * step.transpose();
  }
  return sum;
}

/// Independent numbers a frame: a process that remembers as exp(−k²/2τ²) has 1/(τ √π) of them, and 1/τ² is the ratio of
/// its difference's variance to its own.
double degrees_of_freedom(const FrameMatrix& series, const std::vector<double>& level, Index lag) {
  const Matrix near = difference_products(series, level, 1), far = difference_products(series, level, lag);
  if (!(far.trace() > 0)) return 1;
  const double per_frame = std::min(1.0, std::sqrt(2 * near.trace() / far.trace() / kPi));
  return per_frame * far.trace() * far.trace() / far.squaredNorm();
}

}  // namespace

MotifCode::MotifCode(const FrameMatrix& series, const std::vector<double>& level, int window)
    : sums_(level.size() + 1, 0),
      logarithms_(sums_),
      freedom_(degrees_of_freedom(series, level, std::max(1, window / 2))) {
  const double largest = level.empty() ? 0 : *std::max_element(level.begin(), level.end());
  const double least = std::max(1e-300, kResolution * kResolution * largest * largest);
  for (std::size_t t = 0; t < level.size(); ++t) {
    const double variance = std::max(least, level[t] * level[t]);
    sums_[t + 1] = sums_[t] + variance;
    logarithms_[t + 1] = logarithms_[t] + std::log(variance);
  }
  place_ = std::log(std::max<double>(1, static_cast<double>(level.size())));
}

double MotifCode::saved(int start, int length, double correlation) const {
  const auto from = static_cast<std::size_t>(start), to = static_cast<std::size_t>(start + length);
  const double residual = std::max(kLeastResidual, 1 - correlation * correlation) * (sums_[to] - sums_[from]) / length;
  return freedom_ / 2 * (logarithms_[to] - logarithms_[from] - length * std::log(residual)) - place_;
}

}  // namespace motex
