// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/image/planes.h"

namespace motex {

/// The first or last state of a cable.
struct CableEnd {
  double x = 0, y = 0;    ///< pixels
  double vx = 0, vy = 0;  ///< pixels a frame there
  std::int64_t frame = 0;
  std::int32_t cable = 0;  ///< index of the cable
};

/// Elements born together (a firework): births whose lines meet at one place and time.
struct Burst {
  double x = 0, y = 0;      ///< where the paths meet, pixels
  double frame = 0;         ///< when, fractional
  std::vector<int> cables;  ///< indices of its cables
};

/// Sources and sinks, P_B and P_D of [TM02] section 3.
struct BirthDeathMaps {
  int width = 0, height = 0;
  double births_per_frame = 0;  ///< those of bursts left out
  double bursts_per_frame = 0;
  std::vector<CableEnd> births;  ///< that were seen: not those of cables present in the first frame
  std::vector<CableEnd> deaths;  ///< that were seen: not those of cables present in the last frame
  std::vector<Burst> bursts;
  double bandwidth = 0;  ///< deviation of the Parzen window, pixels
  Plane source;          ///< density of births, a pixel; sums to 1 over the picture
  Plane sink;            ///< density of deaths, likewise
  Plane occupancy;       ///< mean number of elements a pixel and frame
  Plane hazard;          ///< probability that an element here dies before the next frame (leaving the picture included)
};

}  // namespace motex
