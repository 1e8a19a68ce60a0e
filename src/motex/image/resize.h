// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/image/planes.h"

namespace motex {

/// The same picture with other pixels: the pixel (x, y) lies at ((x + ½) w / w' − ½, …) of the original. Cubic
/// interpolation (Catmull–Rom, a = −½), its kernel widened when a side gets smaller; edge pixels are repeated outwards.
/// Values may overshoot. The same size gives the same values. Throws InvalidInput unless the sizes are 1 … 32768.
Plane resized(const Plane& plane, int width, int height);
Planes resized(const Planes& planes, int width, int height);

}  // namespace motex
