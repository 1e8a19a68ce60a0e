// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/cable.h"
#include "motex/particles/track.h"

namespace motex {

/// Paths of the cores, numbered like the cables from 0; the points lie where the cores do, also outside the picture.
/// amplitude: the core's peak in luma.
std::vector<Track> tracks_of(const std::vector<Cable>& cables, int num_planes);

/// Coefficient of the luma (BT.601) of a base of 1 or 3 planes.
double luma_coefficient(const Base& base, int num_planes);

}  // namespace motex
