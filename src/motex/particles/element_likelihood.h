// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "motex/particles/moveton_dynamics.h"
#include "motex/particles/textured_motion.h"

namespace motex {

/// log N(value; mean, deviation²) with 2 % of the mass in a Gaussian ten times as wide.
double log_density(double value, double mean, double deviation);

/// log p(z_t | all before) of one coordinate under second-order dynamics whose constant c_i differs from cable to
/// cable: normal–normal updating of c_i, so that the sum over a cable is its exact marginal likelihood (but for the
/// wide 2 %).
class CoordinateLikelihood {
 public:
  /// least: smallest deviation that is believed, in units of the coordinate. is_place: a cable's constant goes with its
  /// first step, not with its first value.
  CoordinateLikelihood(const CoordinateDynamics& dynamics, double least, bool is_place);
  /// The value at birth, which has its density elsewhere.
  void start(double value);
  double next(double value);

 private:
  void set_constant(double beginning);
  const CoordinateDynamics& dynamics_;
  double least_;
  bool is_place_;
  int age_ = 0;
  double last_ = 0, before_last_ = 0;
  double mean_ = 0, variance_ = 0;  ///< of c_i given the cable so far
};

/// Normal distribution of numbers that were seen.
struct SeenNumbers {
  double mean = 0, deviation = 1;
  static SeenNumbers of(const std::vector<double>& values, double fallback_mean, double least_deviation);
};

/// What the elements of one species look like at birth and how they go on.
struct SpeciesLikelihood {
  double log_share = 0;
  MovetonDynamics dynamics;
  std::array<double, kNumBaseKinds> log_kind{};  ///< by BaseKind
  std::array<double, 2> log_sign{};              ///< dark, bright
  std::array<SeenNumbers, 2> ln_size;            ///< of |amplitude|, dark and bright
  SeenNumbers ln_scale;
};

/// Nats of one cable under one species: at birth and step by step.
struct CableLikelihood {
  double looks = 0, motion = 0;
  std::vector<double> steps;  ///< looks + motion of each frame of its life
};

/// Species of a model from its cables and dynamics; one for all free bases where there are no templates.
std::vector<SpeciesLikelihood> species_of(const TexturedMotion& model);

/// amplitudes: peak of the core in each frame, luma.
CableLikelihood likelihood_of(const Cable& cable, const std::vector<double>& amplitudes,
                              const SpeciesLikelihood& species);

}  // namespace motex
