// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "motex/image/image.h"
#include "motex/image/mask.h"
#include "motex/people/clean_plate.h"
#include "motex/people/mask_regions.h"
#include "motex/people/silhouette.h"

namespace motex {

/// What the keyer knows of the plate: one value a square of 2 × 2 pixels (a last odd column or row counts twice).
struct PlateGrid {
  int width = 0, height = 0;             ///< in squares
  std::vector<std::int16_t> sums;        ///< of two rows of pixels: 8 numbers (2 pixels × R, G, B, A) a square
  std::vector<float> inverse_variances;  ///< 1 / variance of a channel of the sum of 4 pixels; 0 = never the actor
};

PlateGrid plate_grid(const CleanPlate& plate, const Mask& garbage);

/// Where the actor is in one frame, in squares of 2 × 2 pixels. Kept between frames it allocates nothing.
struct MatteGrid {
  static constexpr int kInside = 4;  ///< largest depth

  int width = 0, height = 0;
  std::vector<float> differences;    ///< |ΔI|² / variance: 3 on average where the background is seen
  Mask actor;                        ///< squares that show some of the actor
  BoundingBox box;                   ///< of these
  std::vector<std::uint8_t> depths;  ///< 0 = none; squares to the nearest one without the actor, up to kInside
  std::vector<std::uint8_t> rim;     ///< 1 = not of the actor, but one of the eight neighbours is
  /// Colour that the actor has inside, carried over ± 4 squares: Σ w (R, G, B), Σ w.
  std::vector<std::array<float, 4>> inner_colours;

  MaskRegions regions;                        // scratch
  std::vector<double> difference_sums;        // scratch
  std::vector<std::uint8_t> eroded;           // scratch
  std::vector<std::array<float, 4>> blurred;  // scratch
};

struct MatteGridLimits {
  double difference = 20;  ///< squares from here on show the actor
  double min_area = 16;    ///< squares; smaller loose parts are specks
};

/// Fills `grid` from a frame.
void find_actor(const Image& frame, const PlateGrid& plate, const MatteGridLimits& limits, MatteGrid& grid);

}  // namespace motex
