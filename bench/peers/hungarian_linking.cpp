// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "bench/peers/hungarian_linking.h"

#include "motex/particles/best_pairs.h"

namespace motex::peers {
namespace {

struct Expected {
  double x, y;
};

Expected expected(const Track& track, std::int64_t frame, const HungarianOptions& options) {
  const TrackPoint& last = track.points.back();
  double vx = options.vx, vy = options.vy;
  if (track.points.size() > 1) {
    const TrackPoint& before = track.points[track.points.size() - 2];
    const auto span = static_cast<double>(last.frame - before.frame);
    vx = (last.x - before.x) / span;
    vy = (last.y - before.y) / span;
  }
  const auto ahead = static_cast<double>(frame - last.frame);
  return {last.x + ahead * vx, last.y + ahead * vy};
}

}  // namespace

std::vector<Track> link_hungarian(const std::vector<std::vector<TrackPoint>>& frames, const HungarianOptions& options) {
  std::vector<Track> tracks;
  std::vector<std::size_t> open;
  for (std::size_t t = 0; t < frames.size(); ++t) {
    const auto frame = static_cast<std::int64_t>(t);
    std::vector<PairGain> pairs;
    for (std::size_t k = 0; k < open.size(); ++k) {
      const Expected place = expected(tracks[open[k]], frame, options);
      for (std::size_t p = 0; p < frames[t].size(); ++p) {
        const double dx = frames[t][p].x - place.x, dy = frames[t][p].y - place.y;
        const double gain = options.gate * options.gate - dx * dx - dy * dy;
        if (gain > 0) pairs.push_back({static_cast<int>(k), static_cast<int>(p), gain});
      }
    }
    const std::vector<int> found = best_pairs(static_cast<int>(open.size()), static_cast<int>(frames[t].size()), pairs);
    std::vector<char> taken(frames[t].size(), 0);
    std::vector<std::size_t> still;
    for (std::size_t k = 0; k < open.size(); ++k) {
      Track& track = tracks[open[k]];
      if (found[k] >= 0) {
        taken[static_cast<std::size_t>(found[k])] = 1;
        track.points.push_back(frames[t][static_cast<std::size_t>(found[k])]);
        track.points.back().frame = frame;
      }
      if (frame - track.points.back().frame <= options.max_gap) still.push_back(open[k]);
    }
    open = still;
    for (std::size_t p = 0; p < frames[t].size(); ++p) {
      if (taken[p] != 0) continue;
      open.push_back(tracks.size());
      tracks.push_back({0, {frames[t][p]}});
      tracks.back().points.back().frame = frame;
    }
  }
  std::vector<Track> kept;
  for (Track& track : tracks) {
    if (static_cast<int>(track.points.size()) < options.min_points) continue;
    track.id = static_cast<std::int64_t>(kept.size());
    kept.push_back(std::move(track));
  }
  return kept;
}

}  // namespace motex::peers
