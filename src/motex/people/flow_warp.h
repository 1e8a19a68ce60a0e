// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/people/feature_line.h"
#include "motex/people/warp_sprites.h"

namespace motex {

/// Optical flow between two sprites at their places in the film, both ways, over the pixels of both.
struct SpriteFlow {
  BoundingBox box;          ///< pixels of the film
  WarpGrid a_to_b, b_to_a;  ///< a(p) ≈ b(p + a_to_b(p))
  double consistency = 0;   ///< share of the pixels of both from which there and back ends within 2 pixels
};

/// Of luma over middle grey and of alpha, beginning with the field of those lines and going back to it where flow there
/// and back does not end where it began: there something is covered, and flow alone would tear. Without lines the flow
/// as it is.
/// Cost about 10 ms for a person of 200 × 400 pixels.
SpriteFlow sprite_flow(const PlacedSprite& a, const PlacedSprite& b, const std::vector<FeatureLinePair>& lines = {});

/// Both sprites warped along the flow (weight 0: to where a has things, 1: to where b has) and dissolved (0 is a, 1 is
/// b). A pixel y of the film shows a at the x with x + weight · a_to_b(x) = y, and b likewise.
Sprite flow_morph(const PlacedSprite& a, const PlacedSprite& b, const SpriteFlow& flow, double weight, double dissolve,
                  int jobs = 0);

}  // namespace motex
