// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "motex/motion/clip.h"

namespace motex {

/// Points that move, without bones between them: the markers of optical motion capture. Rows are frames. Y is up,
/// right-handed; lengths keep the file's unit.
struct MarkerSet {
  std::string name;                ///< file name without folder and extension
  std::vector<std::string> names;  ///< one a marker, all different
  double frame_time_secs = 0.01;
  double metres_per_unit = 0;  ///< 0 = nobody knows
  FrameMatrix positions;       ///< frames × 3·markers: x, y, z; all three NaN where the marker was not seen

  Index num_frames() const { return positions.rows(); }
  int num_markers() const { return static_cast<int>(names.size()); }
  double frame_rate() const { return 1.0 / frame_time_secs; }
  Vector3 position(Index frame, int marker) const { return positions.block<1, 3>(frame, 3 * marker).transpose(); }
  void set_position(Index frame, int marker, const Vector3& p) {
    positions.block<1, 3>(frame, 3 * marker) = p.transpose();
  }
  /// Whether the marker was seen in that frame.
  bool seen(Index frame, int marker) const { return positions(frame, 3 * marker) == positions(frame, 3 * marker); }
};

/// Throws InvalidInput unless there is a marker, sizes agree, names are neither empty nor given twice, the frame time
/// is positive and each place is finite or wholly NaN.
void check_markers(const MarkerSet& markers);

/// Names that are neither empty nor equal: "marker7" for the one at index 7, "LHEE_2" for the second LHEE.
std::vector<std::string> distinct_marker_names(std::vector<std::string> names);

/// Share of all markers × frames that were not seen, 0 … 1.
double missing_share(const MarkerSet& markers);
/// The same of one marker.
double missing_share(const MarkerSet& markers, int marker);

/// Frames first … first + count − 1. Throws InvalidInput when they are not all there.
MarkerSet slice(const MarkerSet& markers, Index first, Index count);

/// The markers at another rate, on straight lines between frames. A marker that is missing in one of the two frames is
/// missing between them. Frame t of the result is at t · new frame time.
MarkerSet resample(const MarkerSet& markers, double frame_time_secs);

/// Those markers in that order. Throws InvalidInput naming the first that does not exist.
MarkerSet pick_markers(const MarkerSet& markers, const std::vector<std::string>& names);

/// Pairs of markers (first < second) that seem to sit on one rigid part: the deviation of their distance is below 3 %
/// of it, in at least 30 frames in which both are seen, and no other marker lies nearer to both. For pictures. Cost
/// O(markers² · min(frames, 500)).
std::vector<std::pair<int, int>> rigid_pairs(const MarkerSet& markers);

/// Whether the points stretch along z much more than along y and x in most frames, as in files whose z axis is up.
bool looks_z_up(const MarkerSet& markers);

}  // namespace motex
