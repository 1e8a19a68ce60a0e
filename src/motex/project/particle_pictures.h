// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/image/image.h"
#include "motex/markov/transition_matrix.h"
#include "motex/particles/textured_motion.h"
#include "motex/plot/drawing.h"

/// Pictures of what a model of textured motion holds, as the figures of [TM02] show it.
namespace motex {

/// The three base functions as light, each with its symbol beside it ([TM02] Figure 1a).
Drawing base_functions_picture(double cell = 90);

/// Paths of cores on white, at least `min_frames` long, with a red dot where each is born after the first frame ([TM02]
/// Figures 4b, 8a, 11a, 13a).
Drawing paths_picture(const std::vector<Cable>& cables, int width, int height, double magnification = 1,
                      int min_frames = 3);

/// A density as grey, dark = high, as the paper prints source and sink maps: from white at its least value to black at
/// the 99.5 % quantile of the others.
Drawing density_picture(const Plane& density, double magnification = 1);

/// A cable in space and time ([TM02] Figure 1c): its core as a thick line through x, y and t, coils winding round it,
/// bases as discs every few frames; time runs to the right.
Drawing cable_picture(const Cable& cable, double width = 360, double height = 220);

/// States of a chain round a circle, each with its picture, and an arrow for each transition of probability ≥
/// `least`, the wider the more probable, with the probability beside it ([TM02] Figure 6). Throws InvalidInput unless
/// there is one picture a state.
Drawing chain_picture(const TransitionMatrix& chain, const std::vector<Drawing>& pictures, double least = 0.01);

/// Pictures of one size in rows with a caption before each row; every picture `cell` wide.
struct PictureRow {
  std::string caption;
  std::vector<Image> pictures;
};
Drawing picture_rows(const std::vector<PictureRow>& rows, double cell);

}  // namespace motex
