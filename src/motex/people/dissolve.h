// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/people/sprite.h"

namespace motex {

/// (1 − w) · a + w · b of two pictures of one actor over the same rectangle, premultiplied, where both differ little;
/// where they differ much (one eye here, the other there) the change is as much steeper around the middle,
///   w = ½ + (1 + 3 s) (weight − ½), cut to 0 … 1,
///   s = smoothstep (6 … 20 grey levels) of the mean over 6 pixels each way of |Y_a − Y_b| · min(alpha_a, alpha_b) /
///   255, times the square of the smaller alpha over the larger,
/// so that things are seen twice for less time. Outlines (alpha) change with the weight alone. Throws InvalidInput for
/// unlike rectangles.
Sprite dissolve_where_alike(Sprite a, const Sprite& b, double weight);

}  // namespace motex
