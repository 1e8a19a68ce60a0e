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
#include "motex/people/square_sums.h"

namespace motex {

/// What the keyer knows of the plate: one value a square of 2 × 2 pixels (a last odd column or row counts twice).
struct PlateGrid {
  SquareSums sums;
  std::vector<float> inverse_variances;  ///< 1 / variance of a channel of the sum of 4 pixels; 0 = never the actor
};

PlateGrid plate_grid(const CleanPlate& plate, const Mask& garbage);

struct MatteGridLimits {
  double difference = 20;         ///< squares from here on may show the actor, those from three times as much on do
  double min_area = 16;           ///< squares; smaller loose parts are specks
  double min_hole = 2;            ///< squares; smaller holes are filled
  bool open_small_holes = false;  ///< where blur went over them: on a coloured screen
  LightRange light;               ///< that the background may lie in
};

/// Where the actor is in one frame, in squares of 2 × 2 pixels. Kept between frames it allocates nothing.
struct MatteGrid {
  static constexpr int kInside = 6;  ///< largest depth

  SquareSums sums;                 ///< of the frame
  std::array<float, 3> gains{};    ///< of R, G, B: light of the frame / light of the plate where the background is seen
  std::vector<float> differences;  ///< |ΔI|² / variance: 2 on average where the background is seen
  float contrast = 0;              ///< mean difference of the squares that show the actor for sure
  Mask actor;                      ///< squares that show some of the actor
  BoundingBox box;                 ///< of these
  std::vector<std::uint8_t> depths;  ///< 0 = none; squares to the nearest one without the actor, up to kInside
  std::vector<std::uint8_t> rim;     ///< 1 = not of the actor, but one of the eight neighbours is
  /// Colours that the actor has inside, carried over ± 2 and ± 4 squares: Σ w (R, G, B), Σ w of sums over squares.
  std::vector<std::array<float, 4>> near_colours, around_colours;
  /// Colours further inside, one for each kCell × kCell squares, carried over ± 2 cells.
  static constexpr int kCell = 4;
  int cells_across = 0;
  std::vector<std::array<float, 4>> deep_colours;

  int width() const { return sums.width; }
  int height() const { return sums.height; }
  /// The box and one square more on each side, cut to the grid.
  BoundingBox rim_box() const;

  MaskRegions regions;  // scratch, like all below
  Mask pale;
  std::vector<double> difference_sums;
  std::vector<std::uint8_t> level, next_level, line;
  std::vector<std::array<float, 4>> weighted, line_sums, cells;
};

/// Fills `grid` from a frame.
void find_actor(const Image& frame, const PlateGrid& plate, const MatteGridLimits& limits, MatteGrid& grid);

}  // namespace motex
