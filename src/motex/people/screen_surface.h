// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <span>

#include "motex/image/image.h"
#include "motex/image/mask.h"

namespace motex {

/// Colour of an unevenly lit screen: per channel c₀ + c₁x + c₂y + c₃x² + c₄xy + c₅y², x and y from −1 to 1 over the
/// frame.
struct ScreenSurface {
  int width = 0, height = 0;
  std::array<std::array<double, 6>, 3> coefficients{};  ///< R, G, B; grey levels
  double spread = 0;        ///< deviation of the screen's samples from the surface, grey levels, all channels together
  double share = 0;         ///< of all samples that lie on the surface
  double border_share = 0;  ///< the same of those near the left, right and upper border

  std::array<float, 3> at(double x, double y) const;
};

/// The smooth surface that most of the frames show, above all near their border; nothing when no colour is common
/// enough (a fifth of the samples, two fifths near the border) or it is no surface (spread above 10 grey levels; 26 for
/// a strong hue).
std::optional<ScreenSurface> find_screen(std::span<const Image> frames, const Mask* garbage);

}  // namespace motex
