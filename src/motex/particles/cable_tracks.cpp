// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/cable_tracks.h"

namespace motex {

double luma_coefficient(const Base& base, int num_planes) {
  if (num_planes < 3) return static_cast<double>(base.coefficients[0]);
  return luma_of<double>(base.coefficients[0], base.coefficients[1], base.coefficients[2]);
}

std::vector<Track> tracks_of(const std::vector<Cable>& cables, int num_planes) {
  std::vector<Track> tracks;
  tracks.reserve(cables.size());
  for (const Cable& cable : cables) {
    Track& track = tracks.emplace_back();
    track.id = static_cast<std::int64_t>(tracks.size()) - 1;
    track.points.reserve(cable.core.size());
    std::int64_t frame = cable.first_frame;
    for (const Base& core : cable.core) {
      Base grey = core;
      grey.coefficients = {static_cast<float>(luma_coefficient(core, num_planes)), 0, 0};
      track.points.push_back({frame++, core.x, core.y, core.scale, core.angle, peak_amplitude(grey)});
    }
  }
  return tracks;
}

}  // namespace motex
