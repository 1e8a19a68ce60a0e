// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/noisy_autoregression.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "motex/particles/simplex_search.h"

namespace motex {
namespace {

constexpr double kLargestPersistence = 0.995;
constexpr double kObjection = 2.5;  // standard errors

struct Parameters {
  double persistence, noise_variance, spread_variance, error_variance, start_variance;
};

/// What the filter does at one age, the same for every series.
struct Age {
  std::array<double, 3> gain{};    ///< of place (or level), u, m
  double variance = 0;             ///< of the innovation; 0: the first place, which is only a beginning
  std::array<double, 2> effect{};  ///< innovation of the columns that μ and the first u multiply
  double log_likelihood_share = 0;
};

/// State: place p (a level has no memory: keep = 0), u, m.
struct State {
  double p = 0, u = 0, m = 0;
  double predict(double keep, double persistence) {
    u *= persistence;
    p = keep * p + u + m;
    return p;
  }
  void correct(const std::array<double, 3>& gain, double innovation) {
    p += gain[0] * innovation;
    u += gain[1] * innovation;
    m += gain[2] * innovation;
  }
};

struct Covariance {
  double pp = 0, pu = 0, pm = 0, uu = 0, um = 0, mm = 0;

  void predict(double keep, const Parameters& model, bool first) {
    const double phi = model.persistence;
    if (first) {
      uu = model.start_variance;
      um = 0;
      pu = 0;
    } else {
      uu = phi * phi * uu + model.noise_variance;
      um *= phi;
      pu *= phi;
    }
    // p' = keep p + u' + m
    const double old_pp = keep * keep * pp, old_pu = keep * pu, old_pm = keep * pm;
    pp = old_pp + uu + mm + 2 * (old_pu + old_pm + um);
    pu = old_pu + uu + um;
    pm = old_pm + um + mm;
  }
  std::array<double, 3> correct(double variance) {
    const std::array<double, 3> gain{pp / variance, pu / variance, pm / variance};
    uu -= gain[1] * pu;
    um -= gain[1] * pm;
    mm -= gain[2] * pm;
    pu -= gain[1] * pp;
    pm -= gain[2] * pp;
    pp -= gain[0] * pp;
    return gain;
  }
};

/// The first u is a free parameter of all series (a column of effects), so its mean in the state is 0.
std::vector<Age> filter_by_age(const Parameters& model, MeasuredValue kind, std::size_t num_ages) {
  const double keep = kind == MeasuredValue::kPlace ? 1 : 0;
  std::vector<Age> ages(num_ages);
  Covariance covariance;
  covariance.mm = model.spread_variance;
  std::array<State, 2> columns;
  double level = 0, first_u = 1, sum_of_u = 0;
  bool first = true;
  for (std::size_t t = 0; t < num_ages; ++t) {
    if (keep == 1 && t == 0) {
      covariance.pp = model.error_variance;
      continue;
    }
    covariance.predict(keep, model, first);
    const double variance = covariance.pp + model.error_variance;
    ages[t].variance = variance;
    level = keep * level + 1;
    sum_of_u = keep * sum_of_u + first_u;
    const std::array<double, 2> observed{level, sum_of_u};
    for (std::size_t k = 0; k < 2; ++k) ages[t].effect[k] = observed[k] - columns[k].predict(keep, model.persistence);
    ages[t].gain = covariance.correct(variance);
    for (std::size_t k = 0; k < 2; ++k) columns[k].correct(ages[t].gain, ages[t].effect[k]);
    first_u *= model.persistence;
    first = false;
  }
  return ages;
}

struct Likelihood {
  double value = 0;
  double mean = 0, first_u = 0;
};

Likelihood evaluate(const std::vector<CoordinateSeries>& series, MeasuredValue kind, const Parameters& model,
                    std::size_t num_ages) {
  const std::vector<Age> ages = filter_by_age(model, kind, num_ages);
  const double keep = kind == MeasuredValue::kPlace ? 1 : 0;
  double log_det = 0, squares = 0, a00 = 1e-12, a01 = 0, a11 = 1e-12, b0 = 0, b1 = 0;
  std::vector<double> counts(num_ages);
  for (const CoordinateSeries& one : series) {
    State state;
    if (keep == 1) state.p = one.values[0];
    for (std::size_t t = keep == 1 ? 1 : 0; t < one.values.size(); ++t) {
      const Age& age = ages[t];
      const double innovation = one.values[t] - state.predict(keep, model.persistence);
      state.correct(age.gain, innovation);
      squares += innovation * innovation / age.variance;
      b0 += age.effect[0] * innovation / age.variance;
      b1 += age.effect[1] * innovation / age.variance;
      counts[t] += 1;
    }
  }
  for (std::size_t t = 0; t < num_ages; ++t) {
    if (counts[t] == 0) continue;
    const Age& age = ages[t];
    log_det += counts[t] * std::log(age.variance);
    a00 += counts[t] * age.effect[0] * age.effect[0] / age.variance;
    a01 += counts[t] * age.effect[0] * age.effect[1] / age.variance;
    a11 += counts[t] * age.effect[1] * age.effect[1] / age.variance;
  }
  Likelihood out;
  const double determinant = a00 * a11 - a01 * a01;
  if (determinant > 1e-9 * a00 * a11) {
    out.mean = (b0 * a11 - b1 * a01) / determinant;
    out.first_u = (b1 * a00 - b0 * a01) / determinant;
    // a steady process begins at its mean, and the beginnings help to find it
    if (out.first_u * out.first_u * determinant < kObjection * kObjection * a00) out.first_u = 0;
  }
  if (out.first_u == 0) out.mean = b0 / a00;
  squares -= out.mean * b0 + out.first_u * b1;
  out.value = -0.5 * (log_det + squares);
  return out;
}

/// Mean and variance of what the series begin with: the first step of places, the first level.
struct Beginning {
  double mean = 0, variance = 0, scale = 1;
};

Beginning beginning_of(const std::vector<CoordinateSeries>& series, MeasuredValue kind) {
  const auto first_of = [&](const CoordinateSeries& one) {
    return kind == MeasuredValue::kPlace ? one.values[1] - one.values[0] : one.values[0];
  };
  Beginning out;
  for (const CoordinateSeries& one : series) out.mean += first_of(one);
  const auto count = static_cast<double>(series.size());
  out.mean /= count;
  for (const CoordinateSeries& one : series) {
    const double difference = first_of(one) - out.mean;
    out.variance += difference * difference;
  }
  out.variance /= std::max(1.0, count - 1);
  return out;
}

/// Variance of second differences of places, of first differences of levels: the size of all that is fitted.
double difference_variance(const std::vector<CoordinateSeries>& series, MeasuredValue kind) {
  double sum = 0, count = 0;
  for (const CoordinateSeries& one : series) {
    const std::vector<double>& z = one.values;
    for (std::size_t t = 2; t < z.size(); ++t) {
      const double d = kind == MeasuredValue::kPlace ? z[t] - 2 * z[t - 1] + z[t - 2] : z[t] - z[t - 1];
      sum += d * d;
      count += 1;
    }
  }
  return count > 0 ? sum / count : 0;
}

/// Of all steps of places, of all levels.
double plain_mean(const std::vector<CoordinateSeries>& series, MeasuredValue kind) {
  double sum = 0, count = 0;
  for (const CoordinateSeries& one : series) {
    if (kind == MeasuredValue::kPlace) {
      sum += one.values.back() - one.values.front();
      count += static_cast<double>(one.values.size()) - 1;
    } else {
      for (const double value : one.values) sum += value;
      count += static_cast<double>(one.values.size());
    }
  }
  return sum / count;
}

class Objective {
 public:
  Objective(const std::vector<CoordinateSeries>& series, MeasuredValue kind, double error, const DynamicsPrior& prior)
      : series_(series), kind_(kind), error_(error), prior_(prior), beginning_(beginning_of(series, kind)) {
    for (const CoordinateSeries& one : series) num_ages_ = std::max(num_ages_, one.values.size());
  }

  Parameters parameters(const std::vector<double>& point) const {
    Parameters model{};
    model.persistence = kLargestPersistence * std::tanh(point[0]);
    const double floor = prior_.smallest_noise * prior_.smallest_noise;
    model.noise_variance = floor + std::exp(std::min(point[1], 40.0));
    model.spread_variance = std::exp(std::clamp(point[2], -25.0, 40.0));
    model.error_variance = error_ >= 0 ? error_ * error_ : std::exp(std::clamp(point[3], -25.0, 40.0));
    const double of_errors = (kind_ == MeasuredValue::kPlace ? 2 : 1) * model.error_variance;
    model.start_variance =
        std::max(beginning_.variance - of_errors - model.spread_variance, 0.1 * model.noise_variance);
    return model;
  }

  double operator()(const std::vector<double>& point) const {
    const Parameters model = parameters(point);
    const double d = (model.persistence - prior_.persistence) * (model.persistence - prior_.persistence) /
                     (1 - prior_.persistence * prior_.persistence);
    const double ratio = prior_.noise * prior_.noise / model.noise_variance;
    return -evaluate(series_, kind_, model, num_ages_).value + 0.5 * prior_.steps * (d + ratio - std::log(ratio)) +
           0.05 * std::exp(std::clamp(point[2] - point[1], -9.0, 9.0));
  }

  NoisyAutoregressionFit fit(const std::vector<double>& point) const {
    const Parameters model = parameters(point);
    const Likelihood likelihood = evaluate(series_, kind_, model, num_ages_);
    NoisyAutoregressionFit out;
    out.persistence = model.persistence;
    out.noise = std::sqrt(model.noise_variance);
    out.spread = std::sqrt(model.spread_variance);
    out.error = std::sqrt(model.error_variance);
    // of a steady process the plain mean is as good, and does not depend on the rest of the fit
    out.mean = likelihood.first_u == 0 ? plain_mean(series_, kind_) : likelihood.mean;
    out.start_mean = out.mean + likelihood.first_u;
    out.start_deviation = std::sqrt(model.start_variance + model.spread_variance);
    return out;
  }

 private:
  const std::vector<CoordinateSeries>& series_;
  MeasuredValue kind_;
  double error_;
  DynamicsPrior prior_;
  Beginning beginning_;
  std::size_t num_ages_ = 0;
};

}  // namespace

NoisyAutoregressionFit fit_noisy_autoregression(const std::vector<CoordinateSeries>& series, MeasuredValue kind,
                                                double error, const DynamicsPrior& prior) {
  const std::size_t least = kind == MeasuredValue::kPlace ? 2 : 1;
  std::vector<CoordinateSeries> usable;
  for (const CoordinateSeries& one : series)
    if (one.values.size() >= least) usable.push_back(one);
  if (usable.empty()) {
    NoisyAutoregressionFit none;
    none.persistence = prior.persistence;
    none.noise = prior.noise;
    none.error = std::max(error, 0.0);
    return none;
  }
  const Objective objective(usable, kind, error, prior);
  const double size =
      std::log(std::max(difference_variance(usable, kind), prior.smallest_noise * prior.smallest_noise));
  SimplexResult best;
  bool found = false;
  for (const double persistence : {0.2, 0.7, 0.93}) {
    std::vector<double> start{std::atanh(persistence / kLargestPersistence), size - 1, size - 4};
    if (error < 0) start.push_back(size - 2);
    SimplexResult result = minimise_by_simplex(objective, start, 0.7, 1e-3, 250);
    if (!found || result.value < best.value) best = std::move(result);
    found = true;
  }
  best = minimise_by_simplex(objective, best.point, 0.2, 1e-4, 250);
  return objective.fit(best.point);
}

}  // namespace motex
