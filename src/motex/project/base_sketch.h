// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/particles/base.h"
#include "motex/plot/drawing.h"
#include "motex/project/decompose_video.h"

namespace motex {

/// Symbols instead of light, as in [TM02] Figures 1 and 3: a ring for a blob (LoG), a disc for a Gaussian, a bar for
/// Gcos, and for Gsin an edge: a line with a tick to its brighter side. Sizes are the bases' own; positive coefficients
/// black, negative ones blue, weak ones faint. Size of the drawing: the image's, times magnification. full_ink:
/// coefficient from which on a symbol is drawn in full ink; 0 = that which a tenth of the bases have.
Drawing base_sketch(const BaseMap& map, double magnification = 2, double full_ink = 0);

/// A frame and what became of it, as in [TM02] Figure 2: the observed picture, then for each number of bases the
/// reconstruction with its PSNR, and below them the background and the sketches.
Drawing decomposition_figure(const FrameDecomposition& frame);

}  // namespace motex
