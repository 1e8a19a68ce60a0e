// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/rng.h"
#include "motex/image/planes.h"
#include "motex/particles/textured_motion.h"

namespace motex {

/// How a learned cable came and went, as far as the clip shows it.
struct CableFate {
  double vx = 0, vy = 0;              ///< mean velocity, pixels a frame
  double start_vx = 0, start_vy = 0;  ///< of its first steps
  bool birth_seen = false;            ///< not there in the clip's first frame
  bool death_seen = false;            ///< not there in the clip's last frame
  bool enters = false;                ///< a step before its first place it was outside: came over the border
  bool leaves = false;                ///< likewise at its end
  int side = 0;                       ///< over which border it came: 0 left, 1 top, 2 right, 3 bottom
  bool in_burst = false;              ///< born together with others
  /// How many times as easily it dies inside as others would on its path: the posterior mean (d + κ)/(H + κ), where
  /// d = 1 if it did, H = the hazards it went through, of a gamma distribution of mean 1 and variance 1/κ; κ is the
  /// likeliest. Birds live long beside specks that are lost again; one hazard for both would thin out the birds.
  double frailty = 1;
  bool repeats_path = false;  ///< elements like it go its way step by step (path_replay.h)
};

/// Whether a model has so few cables that each counts: laws of motion and of death fitted to them all, and births drawn
/// at random, would then miss what is seen of the clip by far more than a second clip of its kind may differ.
bool are_few(const std::vector<CableFate>& fates);

std::vector<CableFate> fates_of(const TexturedMotion& model);

/// Probability that an element dies before the next frame while it is inside the picture; leaving the picture is not
/// part of it, because places tell that exactly. Deaths over presences, both under a Parzen window, by place or by age:
/// whichever predicts the cables that it was not made from better.
struct DeathLaw {
  bool by_age = false;
  double mean = 0;                    ///< deaths inside / presences
  Plane by_place;                     ///< one value a cell of kCell × kCell pixels
  std::vector<double> by_age_frames;  ///< [age]; later ages as the last one
  static constexpr int kCell = 4;

  double probability(double x, double y, std::int64_t age) const;
};

DeathLaw learn_death_law(const TexturedMotion& model, const std::vector<CableFate>& fates);
/// Sets all frailties. Returns κ.
double learn_frailties(const TexturedMotion& model, const DeathLaw& deaths, std::vector<CableFate>& fates);
/// Deaths where a map says so: its brightness shares out the deaths that the clip has a frame, those by leaving the
/// picture included. map: size of the picture.
DeathLaw death_law_of_map(const TexturedMotion& model, const Plane& map);
/// Deaths with the probability that stands at the place. hazard: 0 … 1, size of the picture.
DeathLaw death_law_of_hazard(const Plane& hazard);

/// A cable of the clip as an example of how elements come, what was not seen of it made up: where the clip cut it, it
/// goes on at its velocity (or its path) to the border, or ends inside as often as others do.
struct BirthExample {
  int cable = 0;
  double x = 0, y = 0;    ///< of its birth; of one that enters, in the picture near the border
  double vx = 0, vy = 0;  ///< there
  bool enters = false;
  int side = 0;
  double residence = 1;  ///< L, frames
  /// L where it was cut off (an element that hardly moves), and where cables are few; −1 = the death law decides.
  std::int64_t life = -1;
  std::int64_t first_step = 0;  ///< of its path, negative before the clip
  bool starts_like = false;     ///< it begins with the first velocity of the cable
  double rate = 0;  ///< births a frame like it: ℓ/(T L) if ℓ of the clip's T frames show it (Little's law)
};

/// Those of bursts left out. Σ rate · L is the mean number of elements in a frame of the clip, and each kind of path
/// has its share of it: censoring costs nothing, elements that were there from the first to the last frame count as
/// much as they should.
std::vector<BirthExample> birth_examples(const TexturedMotion& model, const std::vector<CableFate>& fates,
                                         const DeathLaw& deaths, double kappa, Rng& rng);

/// Bursts a frame like each one, by the same law: those that the clip cuts off count less than one in T.
std::vector<double> burst_rates(const TexturedMotion& model, const std::vector<CableFate>& fates,
                                const DeathLaw& deaths);

}  // namespace motex
