// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/people/feature_line.h"
#include "motex/people/warp_sprites.h"

namespace motex {

/// How far a line's influence goes: its weight at a pixel at distance d is (length^p / (a² + d²)^½)^b with b = 4, so
/// that the lines close by decide. [BN92] has a + d: the squares take away the kink on the line, and the field is
/// smooth enough to be interpolated from a grid.
struct FieldMorphOptions {
  double softness = 6;      ///< a, pixels
  double length_power = 0;  ///< p: 0 = all lines count alike, 1 = by length
  int spacing = 8;          ///< of the grid on which the field is worked out, pixels
};

/// The warp that brings the lines `shown` (of the picture that is made) to the lines `source`: a pixel X has, for each
/// line, u = (X − P)·(Q − P) / ‖Q − P‖², v = (X − P)·⊥(Q − P) / ‖Q − P‖, and would come from
/// X' = P' + u (Q' − P') + v ⊥(Q' − P') / ‖Q' − P'‖; it comes from X + the weighted mean of X' − X. Lines shorter than
/// half a pixel in either picture are left out; without lines nothing moves. [BN92] section 3, [PT04] section 3.2
WarpGrid field_warp(const std::vector<FeatureLine>& shown, const std::vector<FeatureLine>& source,
                    const BoundingBox& box, const FieldMorphOptions& options = {});
/// The same in double precision for one pixel, not interpolated.
WarpGrid::Displacement field_displacement(const std::vector<FeatureLine>& shown, const std::vector<FeatureLine>& source,
                                          double x, double y, const FieldMorphOptions& options = {});

/// Both sprites warped to the lines between theirs (weight 0: those of a, 1: of b) and dissolved (0 is a, 1 is b). The
/// lines are in pixels of the film. Cost at 720 × 480 with 32 lines: about 8 ms of CPU, divided among `jobs` threads.
Sprite field_morph(const PlacedSprite& a, const PlacedSprite& b, const std::vector<FeatureLinePair>& lines,
                   double weight, double dissolve, const FieldMorphOptions& options = {}, int jobs = 0);
/// No warp: (1 − weight) · a + weight · b.
Sprite cross_dissolve(const PlacedSprite& a, const PlacedSprite& b, double weight, int jobs = 0);

}  // namespace motex
