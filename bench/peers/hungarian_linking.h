// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/track.h"

namespace motex::peers {

struct HungarianOptions {
  double gate = 12;       ///< pixels from where a track is expected
  double vx = 0, vy = 0;  ///< what a new track is expected to do, pixels a frame
  int max_gap = 2;        ///< frames that a track may go unseen
  int min_points = 3;
};

/// The usual linker: each frame's points are given to the tracks by one optimal assignment of squared distances from
/// the place that constant velocity leads to; points that are left begin tracks.
/// frames[k]: the points of frame k.
std::vector<Track> link_hungarian(const std::vector<std::vector<TrackPoint>>& frames, const HungarianOptions& options);

}  // namespace motex::peers
