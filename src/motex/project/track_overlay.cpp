// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/track_overlay.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/plot/colour.h"
#include "motex/plot/drawing.h"

namespace motex {
namespace {

constexpr int kWantedWidth = 960;
constexpr int kMostMagnified = 4;
constexpr int kTrailPieces = 4;  // each of one opacity

}  // namespace

TrackOverlay::TrackOverlay(std::vector<Track> tracks, int width, int height, int trail)
    : tracks_(std::move(tracks)),
      width_(width),
      height_(height),
      trail_(std::max(1, trail)),
      magnification_(std::clamp(kWantedWidth / std::max(1, width), 1, kMostMagnified)) {}

Image TrackOverlay::draw(const Image& picture, std::int64_t frame) const {
  if (picture.width != width_ || picture.height != height_)
    throw InvalidInput("the picture under the tracks is " + std::to_string(picture.width) + " x " +
                       std::to_string(picture.height) + ", the tracks are of " + std::to_string(width_) + " x " +
                       std::to_string(height_));
  const double zoom = magnification_;
  const auto place = [zoom](const TrackPoint& point) { return Point{(point.x + 0.5) * zoom, (point.y + 0.5) * zoom}; };
  Drawing drawing;
  drawing.width = width();
  drawing.height = height();
  drawing.add(Picture{{0, 0}, drawing.width, drawing.height, picture});
  for (const Track& track : tracks_) {
    const auto earlier = [](const TrackPoint& point, std::int64_t value) { return point.frame < value; };
    const auto begin = std::lower_bound(track.points.begin(), track.points.end(), frame - trail_, earlier);
    const auto end = std::lower_bound(begin, track.points.end(), frame + 1, earlier);
    if (begin == end || track.points.back().frame < frame) continue;  // not yet born, or gone
    const Rgba colour = unit_colour(static_cast<int>(track.id % 100000));
    for (int piece = 0; piece < kTrailPieces; ++piece) {
      const std::int64_t from = frame - trail_ + piece * trail_ / kTrailPieces,
                         to = frame - trail_ + (piece + 1) * trail_ / kTrailPieces;
      Polyline line{{}, with_alpha(colour, (piece + 1.0) / kTrailPieces), 1.25, 0};
      for (auto point = begin; point != end; ++point)
        if (point->frame >= from && point->frame <= to) line.points.push_back(place(*point));
      if (line.points.size() > 1) drawing.add(std::move(line));
    }
    const TrackPoint& last = *(end - 1);
    if (last.frame == frame) drawing.add(ring(place(last), zoom * std::max(2.0, 2 * last.scale), colour, 1.25));
  }
  return render(drawing);
}

}  // namespace motex
