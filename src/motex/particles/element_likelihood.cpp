// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/element_likelihood.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "motex/particles/cable_tracks.h"
#include "motex/particles/fit_dynamics.h"

namespace motex {
namespace {

constexpr double kOutliers = 0.02;
constexpr double kOutlierWidth = 10;
constexpr double kPseudoCount = 0.5;
constexpr std::size_t kFewest = 5;  // cables to fit anything to
constexpr double kLeastPlace = 0.05, kLeastLogScale = 0.02, kLeastAmplitude = 1, kLeastAngle = 0.02;

double log_normal(double value, double mean, double deviation) {
  const double z = (value - mean) / deviation;
  return -0.5 * z * z - std::log(deviation) - 0.5 * std::log(2 * std::numbers::pi);
}

/// Cables whose coefficients are those of the luma.
std::vector<Cable> cores_of(const TexturedMotion& model, int species) {
  std::vector<Cable> cores;
  for (const Cable& cable : model.cables) {
    if (species >= 0 && cable.species != species) continue;
    Cable& one = cores.emplace_back();
    one.first_frame = cable.first_frame;
    one.core = cable.core;
    for (Base& base : one.core) base.coefficients[0] = static_cast<float>(luma_coefficient(base, model.num_planes));
  }
  return cores;
}

SpeciesLikelihood described(const std::vector<Cable>& cores, const MovetonDynamics* dynamics) {
  SpeciesLikelihood species;
  if (dynamics != nullptr) {
    species.dynamics = *dynamics;
  } else {
    FitDynamicsOptions options;
    options.estimate_errors = true;
    species.dynamics = fit_dynamics(cores, options);
  }
  std::array<double, kNumBaseKinds> kinds{};
  std::array<std::vector<double>, 2> sizes;
  std::vector<double> scales;
  for (const Cable& cable : cores) {
    const Base& first = cable.core.front();
    const double amplitude = peak_amplitude(first);
    kinds[static_cast<std::size_t>(first.kind)] += 1;
    sizes[amplitude > 0 ? 1 : 0].push_back(std::log(std::max(1e-3, std::abs(amplitude))));
    scales.push_back(std::log(first.scale));
  }
  const auto num = static_cast<double>(cores.size());
  for (std::size_t k = 0; k < kinds.size(); ++k)
    species.log_kind[k] = std::log((kinds[k] + kPseudoCount) / (num + kNumBaseKinds * kPseudoCount));
  for (std::size_t k = 0; k < 2; ++k) {
    species.log_sign[k] = std::log((static_cast<double>(sizes[k].size()) + kPseudoCount) / (num + 2 * kPseudoCount));
    species.ln_size[k] = SeenNumbers::of(sizes[k], 3.5, 0.15);
  }
  species.ln_scale = SeenNumbers::of(scales, 0.4, 0.1);
  return species;
}

}  // namespace

double log_density(double value, double mean, double deviation) {
  const double usual = std::log(1 - kOutliers) + log_normal(value, mean, deviation),
               wide = std::log(kOutliers) + log_normal(value, mean, kOutlierWidth * deviation);
  return std::max(usual, wide) + std::log1p(std::exp(-std::abs(usual - wide)));
}

SeenNumbers SeenNumbers::of(const std::vector<double>& values, double fallback_mean, double least_deviation) {
  // Four numbers of deviation 1 around the fallback keep few values from being believed too much.
  constexpr double kPrior = 4;
  double sum = kPrior * fallback_mean, square = kPrior * (1 + fallback_mean * fallback_mean);
  for (const double value : values) {
    sum += value;
    square += value * value;
  }
  const double num = kPrior + static_cast<double>(values.size());
  SeenNumbers seen;
  seen.mean = sum / num;
  seen.deviation = std::max(least_deviation, std::sqrt(std::max(0.0, square / num - seen.mean * seen.mean)));
  return seen;
}

CoordinateLikelihood::CoordinateLikelihood(const CoordinateDynamics& dynamics, double least, bool is_place)
    : dynamics_(dynamics), least_(least), is_place_(is_place) {}

void CoordinateLikelihood::set_constant(double beginning) {
  mean_ = dynamics_.c + dynamics_.c_slope * (beginning - dynamics_.start_mean);
  variance_ = dynamics_.c_spread * dynamics_.c_spread;
}

void CoordinateLikelihood::start(double value) {
  last_ = value;
  age_ = 1;
  set_constant(value);
}

double CoordinateLikelihood::next(double value) {
  if (age_ == 1) {
    const double nats = log_density(value, dynamics_.a0 * last_ + dynamics_.c0, std::max(least_, dynamics_.d0));
    if (is_place_) set_constant(value - last_);
    before_last_ = last_;
    last_ = value;
    age_ = 2;
    return nats;
  }
  const double carried = dynamics_.a * last_ + dynamics_.b * before_last_;
  const double noise = std::max(least_, dynamics_.d), spread = std::sqrt(noise * noise + variance_);
  const double nats = log_density(value, carried + mean_, spread);
  // An outlier says nothing about the constant.
  const double miss = value - carried - mean_;
  if (std::abs(miss) < 4 * spread) {
    const double gain = variance_ / (spread * spread);
    mean_ += gain * miss;
    variance_ *= 1 - gain;
  }
  before_last_ = last_;
  last_ = value;
  return nats;
}

std::vector<SpeciesLikelihood> species_of(const TexturedMotion& model) {
  std::vector<SpeciesLikelihood> all;
  for (std::size_t k = 0; k < model.dynamics.size(); ++k) {
    const std::vector<Cable> cores = cores_of(model, static_cast<int>(k));
    if (cores.size() < kFewest && model.dynamics.size() > 1) continue;
    all.push_back(described(cores, &model.dynamics[k]));
    all.back().log_share = std::log((static_cast<double>(cores.size()) + kPseudoCount) /
                                    (static_cast<double>(model.cables.size()) + kPseudoCount));
  }
  if (all.empty()) all.push_back(described(cores_of(model, -1), nullptr));
  double sum = 0;
  for (const SpeciesLikelihood& species : all) sum += std::exp(species.log_share);
  for (SpeciesLikelihood& species : all) species.log_share -= std::log(sum);
  return all;
}

CableLikelihood likelihood_of(const Cable& cable, const std::vector<double>& amplitudes,
                              const SpeciesLikelihood& species) {
  const MovetonDynamics& dynamics = species.dynamics;
  CoordinateLikelihood x(dynamics.x, kLeastPlace, true), y(dynamics.y, kLeastPlace, true),
      scale(dynamics.log_scale, kLeastLogScale, false), amplitude(dynamics.amplitude, kLeastAmplitude, false),
      angle(dynamics.angle, kLeastAngle, false);
  const Base& first = cable.core.front();
  const bool turns = is_oriented(first.kind);
  const std::size_t sign = amplitudes.front() > 0 ? 1 : 0;
  const double size = std::max(1e-3, std::abs(amplitudes.front())), ln_scale = std::log(first.scale);
  CableLikelihood result;
  result.looks = species.log_kind[static_cast<std::size_t>(first.kind)] + species.log_sign[sign] +
                 log_density(std::log(size), species.ln_size[sign].mean, species.ln_size[sign].deviation) +
                 log_density(ln_scale, species.ln_scale.mean, species.ln_scale.deviation);
  if (turns) result.looks -= std::log(std::numbers::pi);  // any angle
  result.steps.push_back(result.looks);
  x.start(first.x);
  y.start(first.y);
  scale.start(ln_scale);
  amplitude.start(amplitudes.front());
  angle.start(first.angle);
  for (std::size_t k = 1; k < cable.core.size(); ++k) {
    const Base& base = cable.core[k];
    const double motion = x.next(base.x) + y.next(base.y);
    double looks = scale.next(std::log(base.scale)) + amplitude.next(amplitudes[k]);
    if (turns) looks += angle.next(base.angle);
    result.motion += motion;
    result.looks += looks;
    result.steps.push_back(motion + looks);
  }
  return result;
}

}  // namespace motex
