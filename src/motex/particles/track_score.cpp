// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/track_score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "motex/core/error.h"
#include "motex/image/planes.h"
#include "motex/particles/best_pairs.h"

namespace motex {
namespace {

void check_tracks(const std::vector<Track>& tracks) {
  for (const Track& track : tracks)
    for (std::size_t k = 0; k < track.points.size(); ++k) {
      if (k > 0 && track.points[k].frame <= track.points[k - 1].frame)
        throw InvalidInput("track " + std::to_string(track.id) + " has frame " + std::to_string(track.points[k].frame) +
                           " twice, or its frames do not rise");
      if (!std::isfinite(track.points[k].x) || !std::isfinite(track.points[k].y))
        throw InvalidInput("track " + std::to_string(track.id) + " has a place that is no number");
    }
}

/// Calls visit(a point, b point) for the frames that both have; returns how many.
template <typename Visit>
int for_common_frames(const Track& a, const Track& b, const Visit& visit) {
  int num = 0;
  auto p = a.points.begin();
  for (auto q = b.points.begin(); p != a.points.end() && q != b.points.end();) {
    if (p->frame == q->frame) {
      visit(*p++, *q++);
      ++num;
    } else {
      p->frame < q->frame ? ++p : ++q;
    }
  }
  return num;
}

double distance(const TrackPoint& a, const TrackPoint& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// Σ_t over common frames (ε − min(d, ε)) − ε · frames of y alone: what pairing saves against leaving x alone.
double saving(const Track& x, const Track& y, double gate) {
  double saved = 0;
  const int common = for_common_frames(
      x, y, [&](const TrackPoint& p, const TrackPoint& q) { saved += gate - std::min(distance(p, q), gate); });
  return saved - gate * (static_cast<double>(y.points.size()) - common);
}

/// Pairs that are nearer than the gate in some frame; others cannot save anything.
std::vector<PairGain> possible_pairs(const std::vector<Track>& truth, const std::vector<Track>& estimate, double gate) {
  struct Place {
    int track;
    double x, y;
  };
  std::map<std::int64_t, std::vector<Place>> estimates_at;
  for (std::size_t j = 0; j < estimate.size(); ++j)
    for (const TrackPoint& p : estimate[j].points) estimates_at[p.frame].push_back({static_cast<int>(j), p.x, p.y});
  for (auto& [frame, places] : estimates_at)
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.x < b.x; });
  std::vector<PairGain> pairs;
  std::vector<int> last_row(estimate.size(), -1);
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (const TrackPoint& p : truth[i].points) {
      const auto found = estimates_at.find(p.frame);
      if (found == estimates_at.end()) continue;
      const std::vector<Place>& places = found->second;
      auto place =
          std::lower_bound(places.begin(), places.end(), p.x - gate, [](const Place& a, double x) { return a.x < x; });
      for (; place != places.end() && place->x < p.x + gate; ++place) {
        int& row = last_row[static_cast<std::size_t>(place->track)];
        if (row == static_cast<int>(i) || std::abs(place->y - p.y) >= gate) continue;
        row = static_cast<int>(i);
        pairs.push_back({row, place->track, saving(truth[i], estimate[static_cast<std::size_t>(place->track)], gate)});
      }
    }
  return pairs;
}

std::size_t num_points(const std::vector<Track>& tracks) {
  std::size_t num = 0;
  for (const Track& track : tracks) num += track.points.size();
  return num;
}

}  // namespace

TrackingScore score_tracks(const std::vector<Track>& truth, const std::vector<Track>& estimate, double gate) {
  if (!(gate > 0)) throw InvalidInput("the gate must be above 0 pixels");
  if (num_points(truth) == 0) throw InvalidInput("there is no true track to compare with");
  check_tracks(truth);
  check_tracks(estimate);
  const std::vector<int> pair_of = best_pairs(static_cast<int>(truth.size()), static_cast<int>(estimate.size()),
                                              possible_pairs(truth, estimate, gate));
  TrackingScore score;
  score.num_true = static_cast<int>(truth.size());
  score.num_estimated = static_cast<int>(estimate.size());
  double saved = 0, squares = 0;
  std::size_t num_hits = 0, num_paired_points = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (pair_of[i] < 0) continue;
    const Track& pair = estimate[static_cast<std::size_t>(pair_of[i])];
    ++score.num_pairs;
    num_paired_points += pair.points.size();
    saved += saving(truth[i], pair, gate);
    for_common_frames(truth[i], pair, [&](const TrackPoint& p, const TrackPoint& q) {
      const double d = distance(p, q);
      if (d >= gate) return;
      ++num_hits;
      squares += d * d;
    });
  }
  const double nothing = gate * static_cast<double>(num_points(truth));
  score.alpha = saved / nothing;
  score.beta = saved / (nothing + gate * static_cast<double>(num_points(estimate) - num_paired_points));
  const auto hits = static_cast<double>(num_hits);
  score.jsc = hits / (static_cast<double>(num_points(truth) + num_points(estimate)) - hits);
  score.jsc_tracks = score.num_pairs / static_cast<double>(score.num_true + score.num_estimated - score.num_pairs);
  score.rmse = num_hits > 0 ? std::sqrt(squares / hits) : std::numeric_limits<double>::quiet_NaN();
  return score;
}

std::vector<Track> visible_part(const std::vector<Track>& tracks, int width, int height) {
  std::vector<Track> out;
  for (const Track& track : tracks) {
    Track part{track.id, {}};
    for (const TrackPoint& p : track.points) {
      const bool inside = width == 0 || is_inside(p.x, p.y, width, height);
      if (inside && p.amplitude != 0) part.points.push_back(p);
    }
    if (!part.points.empty()) out.push_back(std::move(part));
  }
  return out;
}

}  // namespace motex
