// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/background_process.h"

#include <algorithm>
#include <cmath>

#include "motex/core/rng.h"

namespace motex {
namespace {

constexpr int kHighestOrder = 24;
constexpr std::uint64_t kSeed = 20040607;

using Parts = std::vector<std::vector<double>>;

/// x_t = Σ_k a_k x_{t−k} + e_t by Burg's method; stops at the order of least Schwarz criterion.
std::vector<double> burg(const Parts& parts) {
  double power = 0, count = 0;
  for (const auto& part : parts)
    for (const double x : part) {
      power += x * x;
      count += 1;
    }
  if (count < 8 || power <= 0) return {};
  Parts forward = parts, backward = parts;
  std::vector<double> a, best;
  double variance = power / count, best_criterion = std::log(variance) * count;
  for (std::size_t order = 1; order <= kHighestOrder; ++order) {
    double top = 0, bottom = 0;
    for (std::size_t p = 0; p < parts.size(); ++p)
      for (std::size_t t = order; t < parts[p].size(); ++t) {
        top += forward[p][t] * backward[p][t - 1];
        bottom += forward[p][t] * forward[p][t] + backward[p][t - 1] * backward[p][t - 1];
      }
    if (!(bottom > 0)) break;
    const double reflection = 2 * top / bottom;
    std::vector<double> next(a);
    next.push_back(reflection);
    for (std::size_t k = 0; k + 1 < order; ++k) next[k] = a[k] - reflection * a[order - 2 - k];
    a = std::move(next);
    variance *= std::max(1e-12, 1 - reflection * reflection);
    for (std::size_t p = 0; p < parts.size(); ++p)
      for (std::size_t t = parts[p].size(); t-- > order;) {
        const double f = forward[p][t], b = backward[p][t - 1];
        forward[p][t] = f - reflection * b;
        backward[p][t] = b - reflection * f;
      }
    const double criterion = std::log(variance) * count + static_cast<double>(order) * std::log(count);
    if (criterion < best_criterion) {
      best_criterion = criterion;
      best = a;
    }
    if (variance < 1e-10 * power / count) break;
  }
  return best;
}

Parts parts_of(const FrameMatrix& series, const std::vector<FrameSpan>& spans, Index s, bool differenced) {
  Parts out;
  for (const FrameSpan& span : spans) {
    std::vector<double> part;
    double sum = 0;
    for (int t = span.start; t < span.end(); ++t) {
      const bool has_before = t > span.start && series.row(t - 1).allFinite();
      if (!series.row(t).allFinite() || (differenced && !has_before)) continue;
      const double value = differenced ? series(t, s) - series(t - 1, s) : series(t, s);
      part.push_back(value);
      sum += value;
    }
    for (double& x : part) x -= sum / static_cast<double>(part.size());
    if (part.size() > 2) out.push_back(std::move(part));
  }
  return out;
}

double predicted(const std::vector<double>& a, const double* at, std::size_t known) {
  double sum = 0;
  for (std::size_t k = 0; k < std::min(a.size(), known); ++k) sum += a[k] * *(at - 1 - static_cast<std::ptrdiff_t>(k));
  return sum;
}

/// Lower triangle L with L Lᵀ = covariance of the innovations (ridge keeps it positive).
Matrix innovations(const std::vector<Parts>& signals, const std::vector<std::vector<double>>& models) {
  const auto n = static_cast<Index>(signals.size());
  Matrix covariance = Matrix::Zero(n, n);
  double count = 1;
  for (std::size_t p = 0; p < signals[0].size(); ++p)
    for (std::size_t t = 0; t < signals[0][p].size(); ++t) {
      Vector e(n);
      for (Index s = 0; s < n; ++s) {
        const auto& part = signals[static_cast<std::size_t>(s)][p];
        e[s] = part[t] - predicted(models[static_cast<std::size_t>(s)], part.data() + t, t);
      }
      covariance += e * e.transpose();
      count += 1;
    }
  covariance /= count;
  Matrix lower = Matrix::Zero(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j <= i; ++j) {
      double rest = covariance(i, j);
      for (Index k = 0; k < j; ++k) rest -= lower(i, k) * lower(j, k);
      if (i == j)
        lower(i, i) = std::sqrt(std::max(rest, 1e-9 * covariance(i, i) + 1e-300));
      else
        lower(i, j) = rest / lower(j, j);
    }
  return lower;
}

}  // namespace

FrameMatrix background_series(const FrameMatrix& series, const std::vector<FrameSpan>& parts, double memory,
                              bool differenced, int num_frames) {
  const Index num_signals = series.cols();
  std::vector<Parts> signals;
  std::vector<std::vector<double>> models;
  for (Index s = 0; s < num_signals; ++s) {
    signals.push_back(parts_of(series, parts, s, differenced));
    models.push_back(burg(signals.back()));
    double shrink = 1;
    for (double& a : models.back()) a *= shrink *= std::exp(-1 / memory);
  }
  FrameMatrix out = FrameMatrix::Zero(num_frames, num_signals);
  if (signals.empty() || signals[0].empty()) return out;
  const Matrix lower = innovations(signals, models);
  Rng rng(kSeed);
  const int warm_up = static_cast<int>(4 * memory) + kHighestOrder, total = num_frames + warm_up;
  std::vector<std::vector<double>> x(static_cast<std::size_t>(num_signals),
                                     std::vector<double>(static_cast<std::size_t>(total)));
  Vector noise(num_signals);
  for (int t = 0; t < total; ++t) {
    for (Index s = 0; s < num_signals; ++s) noise[s] = rng.normal();
    for (Index s = 0; s < num_signals; ++s) {
      double* at = x[static_cast<std::size_t>(s)].data() + t;
      *at = predicted(models[static_cast<std::size_t>(s)], at, static_cast<std::size_t>(t)) + lower.row(s).dot(noise);
    }
  }
  for (Index s = 0; s < num_signals; ++s) {
    double level = 0;
    for (int t = 0; t < num_frames; ++t) {
      const double value = x[static_cast<std::size_t>(s)][static_cast<std::size_t>(t + warm_up)];
      level = differenced ? level + value : value;
      out(t, s) = level;
    }
  }
  return out;
}

}  // namespace motex
