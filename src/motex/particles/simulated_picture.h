// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "motex/core/rng.h"
#include "motex/image/planes.h"
#include "motex/particles/simulate.h"

/// What the simulators draw with.
namespace motex {

/// Gaussian of deviations `along` and `across` an axis at `angle`, of that peak in each plane, onto planes.
struct DrawnBlob {
  double x = 0, y = 0;
  double along = 1, across = 1;
  double angle = 0;
  std::array<double, 3> peak{};
};
/// Adds it.
void add_blob(Planes& planes, const DrawnBlob& blob);
/// Puts it over what is there, which shines through where the Gaussian is below 1: for dark bodies. peak = its colour.
void cover_with_blob(Planes& planes, const DrawnBlob& blob, double opacity);

/// `level` + smooth noise of that deviation and 3 pixels width.
Plane textured_background(int width, int height, double level, double texture, Rng& rng);

/// Adds noise of that deviation, rounds and cuts to 8 bits.
Image noisy_picture(Planes planes, double noise, Rng& rng);

/// A scene of that size, rate and movement, as yet without elements.
template <typename Options>
SimulatedScene empty_scene(const Options& options, const Planes& background) {
  SimulatedScene scene;
  scene.width = options.width;
  scene.height = options.height;
  scene.frames_per_sec = options.frames_per_sec;
  scene.persistence = options.persistence;
  scene.noise = options.deviation;
  scene.background = to_image(background);
  return scene;
}

/// Fills in num_frames pictures: the background, what `draw` puts on it in that frame, and noise of that deviation.
void draw_frames(SimulatedScene& scene, const Planes& background, int num_frames, double noise, std::uint64_t seed,
                 const std::function<void(int frame, Planes& planes)>& draw);

/// Poisson distributed.
int draw_poisson(Rng& rng, double mean);

}  // namespace motex
