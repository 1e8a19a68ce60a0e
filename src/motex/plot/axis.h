// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace motex {

struct Axis {
  std::string label;
  bool log = false;                ///< logarithmic; values ≤ 0 are left out
  std::optional<double> min, max;  ///< fixed ends; without them the data's, rounded outwards
};

struct Tick {
  double value;
  std::string text;
};

/// Range of an axis and where it is marked: multiples of 1, 2 or 5 × a power of ten, on logarithmic axes such numbers.
struct Scale {
  double min = 0, max = 1;
  bool log = false;
  std::vector<Tick> ticks;
  /// Place of a value: 0 at min, 1 at max.
  double place(double value) const;
};

/// Scale for finite values low … high with about that many ticks. Equal or missing ends are widened.
Scale make_scale(const Axis& axis, double low, double high, int about_ticks);

}  // namespace motex
