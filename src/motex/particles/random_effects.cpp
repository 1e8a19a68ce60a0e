// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/random_effects.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "motex/core/matrix.h"

namespace motex {
namespace {

// columns: x_{t−1}, x_{t−2}, 1, x_first − start_mean, x_t
constexpr int kLag1 = 0, kLag2 = 1, kOne = 2, kStart = 3, kNow = 4, kColumns = 5;
constexpr double kObjection = 2.5;  // standard errors
using Row = Eigen::Matrix<double, kColumns, 1>;
using Moments = Eigen::Matrix<double, kColumns, kColumns>;
using Regressors = Eigen::Matrix<double, kNow, 1>;
using Normal = Eigen::Matrix<double, kNow, kNow>;

struct Group {
  Row sum = Row::Zero();
  double count = 0;
};

struct Data {
  Moments moments = Moments::Zero();
  std::vector<Group> groups;
  double count = 0, centre = 0, start_mean = 0, start_variance = 0;
};

Data collect(const std::vector<CoordinateSeries>& series, int order) {
  Data data;
  double starts = 0, sum = 0, square = 0, total = 0, num = 0;
  for (const CoordinateSeries& one : series) {
    if (one.values.empty()) continue;
    starts += 1;
    sum += one.values[0];
    for (const double x : one.values) total += x;
    num += static_cast<double>(one.values.size());
  }
  if (starts == 0) return data;
  data.centre = total / num;  // moments about it keep their digits
  data.start_mean = sum / starts;
  for (const CoordinateSeries& one : series)
    if (!one.values.empty()) square += (one.values[0] - data.start_mean) * (one.values[0] - data.start_mean);
  data.start_variance = starts > 1 ? square / (starts - 1) : 0;
  const auto first = static_cast<std::size_t>(order);
  for (const CoordinateSeries& one : series) {
    if (one.values.size() <= first) continue;
    Group group;
    for (std::size_t t = first; t < one.values.size(); ++t) {
      Row row;
      row << one.values[t - 1] - data.centre, order == 2 ? one.values[t - 2] - data.centre : 0, 1,
          one.values[0] - data.start_mean, one.values[t] - data.centre;
      data.moments += row * row.transpose();
      group.sum += row;
      group.count += 1;
    }
    data.count += group.count;
    data.groups.push_back(group);
  }
  return data;
}

struct Solution {
  Regressors coefficients = Regressors::Zero();
  Normal covariance = Normal::Zero();  ///< over d²
  double noise_variance = 1, log_likelihood = 0;
};

/// Lag 2 and the slope are left out by a ridge so large that they are 0.
Normal prior_weights(const Data& data, int order, bool with_slope, const DynamicsPrior& prior) {
  const double scale = prior.noise * prior.noise / (1 - prior.persistence * prior.persistence);
  const double none = 1e12 * (1 + data.moments.trace());
  Regressors weights = Regressors::Constant(1e-9 * (scale + data.moments.trace() / (1 + data.count)));
  weights[kLag1] += prior.steps * scale;
  weights[kLag2] += order == 2 ? prior.steps * scale : none;
  weights[kOne] = 1e-9;
  weights[kStart] += with_slope ? prior.steps * scale : none;
  return weights.asDiagonal();
}

Solution solve(const Data& data, double ratio, const Normal& weights, const DynamicsPrior& prior) {
  Moments moments = data.moments;
  double log_det = 0;
  for (const Group& group : data.groups) {
    moments -= (ratio / (1 + group.count * ratio)) * group.sum * group.sum.transpose();
    log_det += std::log1p(group.count * ratio);
  }
  Regressors mean = Regressors::Zero();
  mean[kLag1] = prior.persistence;
  const Normal normal = moments.topLeftCorner<kNow, kNow>() + weights;
  const Regressors right = moments.col(kNow).head<kNow>() + weights * mean;
  Solution out;
  const Eigen::LDLT<Normal> factor(normal);
  out.coefficients = factor.solve(right);
  out.covariance = factor.solve(Normal::Identity());
  const double residual = moments(kNow, kNow) + mean.dot(weights * mean) - out.coefficients.dot(right);
  const double degrees = data.count + prior.steps;
  out.noise_variance = degrees > 0 ? (std::max(residual, 0.0) + prior.steps * prior.noise * prior.noise) / degrees : 1;
  out.noise_variance = std::max(out.noise_variance, prior.smallest_noise * prior.smallest_noise);
  out.log_likelihood = -0.5 * (degrees * std::log(out.noise_variance) + log_det);
  return out;
}

/// Golden section over log λ; λ = 0 when that is as likely.
double best_ratio(const Data& data, const Normal& weights, const DynamicsPrior& prior) {
  if (data.groups.size() < 4) return 0;
  const auto value = [&](double log_ratio) { return solve(data, std::exp(log_ratio), weights, prior).log_likelihood; };
  constexpr double kGolden = 0.6180339887498949;
  double low = std::log(1e-5), high = std::log(1e4);
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  double at_left = value(left), at_right = value(right);
  while (high - low > 0.02) {
    if (at_left >= at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kGolden * (high - low);
      at_left = value(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kGolden * (high - low);
      at_right = value(right);
    }
  }
  const double best = (low + high) / 2;
  return value(best) > solve(data, 0, weights, prior).log_likelihood + 0.5 ? std::exp(best) : 0;
}

}  // namespace

AutoregressionFit fit_random_effects(const std::vector<CoordinateSeries>& series, int order,
                                     const DynamicsPrior& prior) {
  const Data data = collect(series, order);
  Normal weights = prior_weights(data, order, true, prior);
  double ratio = best_ratio(data, weights, prior);
  Solution solution = solve(data, ratio, weights, prior);
  const double slope_variance = solution.covariance(kStart, kStart) * solution.noise_variance;
  double slope = solution.coefficients[kStart];
  if (data.groups.size() < 4 || slope * slope < 4 * slope_variance) {  // nothing says that it is not 0
    weights = prior_weights(data, order, false, prior);
    ratio = best_ratio(data, weights, prior);
    solution = solve(data, ratio, weights, prior);
    slope = 0;
  }
  AutoregressionFit fit;
  fit.lag1 = solution.coefficients[kLag1];
  fit.lag2 = order == 2 ? solution.coefficients[kLag2] : 0;
  // the mean of all values is the better estimate of where a steady process stays, unless the regression objects
  const double intercept = data.count > 0 ? solution.coefficients[kOne] : 0;
  const double variance = solution.covariance(kOne, kOne) * solution.noise_variance;
  const bool is_steady = intercept * intercept < kObjection * kObjection * variance;
  fit.constant = data.centre * (1 - fit.lag1 - fit.lag2) + (is_steady ? 0 : intercept);
  fit.noise = std::sqrt(solution.noise_variance);
  fit.slope = slope;
  fit.start_mean = data.start_mean;
  fit.start_deviation = std::sqrt(data.start_variance);
  const double explained = slope == 0 ? 0 : std::max(0.0, slope * slope - slope_variance) * data.start_variance;
  fit.spread = std::sqrt(ratio * solution.noise_variance + explained);
  return fit;
}

}  // namespace motex
