// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/cable_exit.h"

#include <algorithm>
#include <array>

namespace motex {

StraightExit straight_exit(const TexturedMotion& model, double x, double y, double vx, double vy) {
  const double none = std::numeric_limits<double>::infinity();
  const std::array<double, 4> times{vx < 0 ? (x + 0.5) / -vx : none, vy < 0 ? (y + 0.5) / -vy : none,
                                    vx > 0 ? (model.width - 0.5 - x) / vx : none,
                                    vy > 0 ? (model.height - 0.5 - y) / vy : none};
  const auto first = std::min_element(times.begin(), times.end());
  return {std::max(*first, 0.0), static_cast<int>(first - times.begin())};
}

}  // namespace motex
