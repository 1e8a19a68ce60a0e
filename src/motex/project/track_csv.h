// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "motex/particles/track.h"

namespace motex {

/// Tracks from a table with a heading: columns frame, x, y and id (or track, particle), in any order; amplitude (amp),
/// scale (size, sigma) and angle (theta) where they are there; others are passed over. Separator comma, semicolon or
/// tab. Tracks in rising order of id. Throws ParseError with the line: a column missing, no number, an id twice in a
/// frame. name: for messages.
std::vector<Track> parse_tracks_csv(std::string_view text, const std::string& name);

/// Detections from such a table: no column for the track is needed, and one that is there is passed over. Rows in the
/// order of the file.
std::vector<TrackPoint> parse_points_csv(std::string_view text, const std::string& name);

/// Table of tracks as parse_tracks_csv() reads it, made row by row: columns track, frame, x, y, scale, angle,
/// amplitude; pixels, radians, grey levels; four decimals. Only points whose centre lies inside the picture,
/// −½ ≤ x < width − ½, stand in it.
class TrackCsv {
 public:
  TrackCsv(int width, int height) : width_(width), height_(height) {}
  /// Adds the row of that point to the text, nothing when it lies outside; the caller writes heading() first.
  void append(std::int64_t track, const TrackPoint& point, std::string& text);
  std::int64_t num_rows() const { return num_rows_; }
  static const char* heading() { return "track,frame,x,y,scale,angle,amplitude\n"; }

 private:
  int width_, height_;
  std::int64_t num_rows_ = 0;
};

/// The whole table, heading included, in the order given.
std::string tracks_csv(const std::vector<Track>& tracks, int width, int height);

}  // namespace motex
