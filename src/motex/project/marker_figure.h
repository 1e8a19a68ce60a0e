// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/motion/markers.h"
#include "motex/project/figure.h"

namespace motex {

/// The side that a marker's name tells: that of its first or last letter (LHEE, ARMl) where the other side's name is
/// there too, else as side_of_name.
Side side_of_marker(const MarkerSet& markers, int marker);

/// Markers as small balls, and thin sticks between those that keep their distance (rigid_pairs). Hips are the ASIS
/// markers, hands and feet the wrists' and ankles', by the usual names; missing ones are left out.
FigureMotion figure_motion(const MarkerSet& markers);

}  // namespace motex
