// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "motex/core/rng.h"
#include "motex/image/planes.h"

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

/// Poisson distributed.
int draw_poisson(Rng& rng, double mean);

}  // namespace motex
