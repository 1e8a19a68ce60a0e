// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/cable.h"

namespace motex {

/// What is left of a frame around one core: a piece of the residual in which the pixels of other cores are zero.
struct CoilWindow {
  int left = 0, top = 0;
  Plane residual;
};

/// The pixels within `reach` core scales (and the coil's own extent) of the core. others: cores that may own some.
CoilWindow cut_window(const Plane& residual, const Base& core, const std::vector<Base>& others, double reach);

/// A coil base in image coordinates; energy = squared coefficient (luma).
struct CoilFit {
  Base base;
  float coefficient = 0;
  double energy() const { return static_cast<double>(coefficient) * static_cast<double>(coefficient); }
};

/// The best base of a small dictionary around the core (Gaussians of three scales, bars and edges of six directions at
/// the strongest places), fitted continuously. Energy 0 when no place reaches min_coefficient.
CoilFit find_coil(const CoilWindow& window, const Base& core, double reach, double min_coefficient);

/// The base where it was relative to the core in another frame, fitted again. Energy 0 when it left the reach.
CoilFit carry_coil(const CoilWindow& window, const Base& core, const CoilFit& from, const Base& from_core,
                   double reach);

/// The same base relative to another core: moved, scaled and (oriented cores) turned with it.
Base moved_with_core(const Base& base, const Base& from_core, const Base& to_core);

}  // namespace motex
