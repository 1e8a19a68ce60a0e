// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/textured_motion.h"

namespace motex {

/// How well a model Θ accounts for the elements W that were followed in a clip, in nats; all normalising constants are
/// in, so that models can be compared: they all explain the same W.
///
///   log p(W | Θ) = births + places + looks + motion + deaths
///   births  Σ_t log NB(n_t): how many are born in a frame (negative binomial: elements born together are common in
///           some textures), and in the first frame how many are there
///   places  Σ log of the source map where they are born (the occupancy map in the first frame), a fifth uniform
///   looks   kind of core, sign, ln amplitude and ln scale at birth, and how scale, amplitude and angle change
///   motion  Σ log p(z_t | z_{t−1}, z_{t−2}, …) of x and y by the model's second-order dynamics, each cable's own drift
///           c_i integrated out as it becomes known; 2 % in a Gaussian ten times as wide, so that one false link does
///           not decide
///   deaths  Σ log hazard where an element died, log(1 − hazard) where it lived on; those of the last frame censored
/// Species are summed over: log Σ_k share_k p(cable | k). Places of a clip of another size are scaled to the model's.
struct Explanation {
  double births = 0, places = 0, looks = 0, motion = 0, deaths = 0;
  double num_elements = 0;  ///< element-frames
  double num_frames = 0;
  /// [cable][frame of its life]: −log p of that step, in deviations above the mean of the model's own elements.
  std::vector<std::vector<double>> surprise;

  double total() const { return births + places + looks + motion + deaths; }
  double per_element() const { return num_elements > 0 ? total() / num_elements : 0; }
  double per_frame() const { return num_frames > 0 ? total() / num_frames : 0; }
};

/// observed: a clip learned (or tracked) by itself; of it size, number of frames and cables are used.
/// Throws InvalidInput when the model has no cables, or nothing was followed in the clip.
Explanation explain_cables(const TexturedMotion& model, const TexturedMotion& observed);

/// Probability of each model, all equally probable before: exp(total) / Σ exp(total).
std::vector<double> model_probabilities(const std::vector<Explanation>& explanations);

/// Where elements are unlikely: what surprise they have beyond two deviations, summed over all that pass within about
/// `bandwidth` pixels.
Plane abnormality_map(const TexturedMotion& observed, const Explanation& explanation, double bandwidth);
/// When: the same summed over the elements of each frame.
std::vector<double> abnormality_over_time(const TexturedMotion& observed, const Explanation& explanation);

}  // namespace motex
