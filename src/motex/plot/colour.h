// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/image/image.h"

namespace motex {

/// Colour of perceived lightness 0 … 1, chroma 0 … 0.37 and hue in degrees (Oklch), cut to what sRGB can show.
Rgba oklch(double lightness, double chroma, double hue_deg);

/// Colour of line number idx ≥ 0 of a plot: eight that differ well on white, then again.
Rgba series_colour(int idx);

/// Colour of unit number idx ≥ 0 (texton, moveton, motif): hues turn by the golden angle, so neighbours differ and any
/// number of units gets its own; lightness alternates. Legible on white and on black.
Rgba unit_colour(int idx);

/// Colour scale from dark violet (0) over green to light yellow (1); lightness rises evenly. NaN is grey.
Rgba heat_colour(double value);

}  // namespace motex
