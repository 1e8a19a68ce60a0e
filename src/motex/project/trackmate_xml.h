// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "motex/particles/track.h"

namespace motex {

/// What TrackMate wants to know of the clip that the tracks are from.
struct TrackedClip {
  std::string file_name;  ///< of the clip, without folder; empty = unknown
  std::string folder;     ///< of the clip; empty = beside the XML file
  int width = 0, height = 0;
  std::int64_t num_frames = 0;
  double pixel_size = 1;              ///< length units a pixel
  double frame_interval = 1;          ///< time units a frame
  std::string length_unit = "pixel";  ///< of positions and radii
  std::string time_unit = "frame";
};

/// A session file of TrackMate 7 (ImageJ's tracker) that "Load a TrackMate file" opens: spots (position, radius √2 ·
/// scale, quality = |amplitude|, and our own features AMPLITUDE and ANGLE), edges between the points of a track, all
/// tracks visible. Points of the tracks are in pixels; the file has the clip's units, origin at the centre of the top
/// left pixel in both. Points outside the picture are left out (width 0: none); a track that is left with one point is
/// a spot without a track.
std::string trackmate_xml(const std::vector<Track>& tracks, const TrackedClip& clip);

/// The simple table of tracks that TrackMate's action "Export tracks to XML file" writes.
std::string trackmate_simple_xml(const std::vector<Track>& tracks, const TrackedClip& clip);

}  // namespace motex
