// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "motex/particles/textured_motion.h"

namespace motex {

/// Frames until a straight path leaves the picture, and where.
struct StraightExit {
  double frames = std::numeric_limits<double>::infinity();
  int side = 0;
};

StraightExit straight_exit(const TexturedMotion& model, double x, double y, double vx, double vy);

}  // namespace motex
