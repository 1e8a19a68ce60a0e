// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace motex {

struct TrackPoint {
  std::int64_t frame = 0;
  double x = 0;  ///< pixels, origin at the centre of the top left pixel, y downwards
  double y = 0;
  double scale = 0;      ///< pixels; 0 = unknown
  double angle = 0;      ///< radians
  double amplitude = 1;  ///< grey levels
};

/// The path of one element; frames rise and may have gaps.
struct Track {
  std::int64_t id = 0;
  std::vector<TrackPoint> points;
};

}  // namespace motex
