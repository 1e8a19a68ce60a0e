// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/markers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr Index kFramesLookedAt = 500;
constexpr Index kLeastCommonFrames = 30;
constexpr double kRigid = 0.03;  // deviation of a distance, as a share of it
constexpr double kLargestFrames = 1e8;

std::size_t at(int idx) { return static_cast<std::size_t>(idx); }

/// What is known of the distance of two markers.
struct Distance {
  double mean = 0;
  bool rigid = false;
};

Distance distance_between(const MarkerSet& markers, int a, int b) {
  const Index step = std::max<Index>(1, markers.num_frames() / kFramesLookedAt);
  double sum = 0, squares = 0, count = 0;
  for (Index t = 0; t < markers.num_frames(); t += step) {
    const double d = (markers.position(t, a) - markers.position(t, b)).norm();
    if (std::isnan(d)) continue;
    sum += d, squares += d * d, ++count;
  }
  if (count < std::min<double>(kLeastCommonFrames, static_cast<double>(markers.num_frames()))) return {};
  const double mean = sum / count;
  const double deviation = std::sqrt(std::max(0.0, squares / count - mean * mean));
  return {mean, count > 0 && mean > 0 && deviation < kRigid * mean};
}

MarkerSet without_positions(const MarkerSet& markers) {
  MarkerSet out;
  out.name = markers.name;
  out.names = markers.names;
  out.frame_time_secs = markers.frame_time_secs;
  out.metres_per_unit = markers.metres_per_unit;
  return out;
}

}  // namespace

void check_markers(const MarkerSet& markers) {
  const std::string who = markers.name.empty() ? "the markers" : markers.name;
  if (markers.names.empty()) throw InvalidInput(who + ": there is no marker");
  if (markers.positions.cols() != 3 * markers.num_markers())
    throw InvalidInput(who + ": the array of positions does not fit the names");
  if (!(markers.frame_time_secs > 0) || !std::isfinite(markers.frame_time_secs))
    throw InvalidInput(who + ": the frame time must be positive");
  std::set<std::string> known;
  for (const std::string& name : markers.names)
    if (name.empty() || !known.insert(name).second)
      throw InvalidInput(who + ": marker name '" + name + "' is empty or given twice");
  for (Index t = 0; t < markers.num_frames(); ++t)
    for (int m = 0; m < markers.num_markers(); ++m) {
      const Vector3 p = markers.position(t, m);
      if (!p.allFinite() && !p.array().isNaN().all())
        throw InvalidInput(who + ": frame " + std::to_string(t) + ", marker '" + markers.names[at(m)] +
                           "': the position is neither finite nor missing");
    }
}

std::vector<std::string> distinct_marker_names(std::vector<std::string> names) {
  const std::set<std::string> stated(names.begin(), names.end());
  std::set<std::string> used;
  std::map<std::string, int> next;  // number to try for a name given again
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string base = names[i].empty() ? "marker" + std::to_string(i) : names[i];
    std::string name = base;
    // A name made here must not take one that a later marker states.
    while (used.count(name) > 0 || (name != names[i] && stated.count(name) > 0))
      name = base + "_" + std::to_string(++next.try_emplace(base, 1).first->second);
    used.insert(name);
    names[i] = std::move(name);
  }
  return names;
}

double missing_share(const MarkerSet& markers, int marker) {
  if (markers.num_frames() == 0) return 0;
  return markers.positions.col(3 * marker).array().isNaN().cast<double>().mean();
}

double missing_share(const MarkerSet& markers) {
  double sum = 0;
  for (int m = 0; m < markers.num_markers(); ++m) sum += missing_share(markers, m);
  return markers.names.empty() ? 0 : sum / markers.num_markers();
}

MarkerSet slice(const MarkerSet& markers, Index first, Index count) {
  if (first < 0 || count < 0 || first > markers.num_frames() || count > markers.num_frames() - first)
    throw InvalidInput("frames " + std::to_string(first) + " … " + std::to_string(first + count - 1) +
                       " are not all in " + markers.name + ", which has " + std::to_string(markers.num_frames()));
  MarkerSet out = without_positions(markers);
  out.positions = markers.positions.middleRows(first, count);
  return out;
}

MarkerSet resample(const MarkerSet& markers, double frame_time_secs) {
  if (!(frame_time_secs > 0) || !std::isfinite(frame_time_secs))
    throw InvalidInput("the new frame time must be positive");
  if (markers.num_frames() == 0) throw InvalidInput(markers.name + ": no frame to resample");
  const double ratio = frame_time_secs / markers.frame_time_secs;
  const double length = static_cast<double>(markers.num_frames() - 1);
  const double last = std::floor(length / ratio + 1e-6);
  if (last > kLargestFrames) throw InvalidInput("the new rate would make more than 100 million frames");
  MarkerSet out = without_positions(markers);
  out.frame_time_secs = frame_time_secs;
  out.positions.resize(static_cast<Index>(last) + 1, markers.positions.cols());
  for (Index t = 0; t < out.num_frames(); ++t) {
    double place = std::min(static_cast<double>(t) * ratio, length);
    // Within rounding of a frame is that frame, so that its neighbour's gaps do not spread.
    if (std::abs(place - std::round(place)) < 1e-6) place = std::round(place);
    const auto a = static_cast<Index>(place);
    const double w = place - static_cast<double>(a);
    if (w == 0)
      out.positions.row(t) = markers.positions.row(a);
    else
      out.positions.row(t) = (1 - w) * markers.positions.row(a) + w * markers.positions.row(a + 1);
  }
  return out;
}

MarkerSet pick_markers(const MarkerSet& markers, const std::vector<std::string>& names) {
  MarkerSet out = without_positions(markers);
  out.names = names;
  out.positions.resize(markers.num_frames(), 3 * static_cast<Index>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = std::find(markers.names.begin(), markers.names.end(), names[i]);
    if (found == markers.names.end()) throw InvalidInput(markers.name + ": there is no marker '" + names[i] + "'");
    out.positions.middleCols<3>(3 * static_cast<Index>(i)) =
        markers.positions.middleCols<3>(3 * static_cast<Index>(found - markers.names.begin()));
  }
  return out;
}

std::vector<std::pair<int, int>> rigid_pairs(const MarkerSet& markers) {
  constexpr int kMostMarkers = 300;  // beyond, a picture shows points alone
  const int n = markers.num_markers();
  std::vector<std::pair<int, int>> pairs;
  if (n > kMostMarkers || markers.num_frames() < 2) return pairs;
  std::vector<Distance> distances(at(n) * at(n));
  const auto between = [&](int a, int b) -> Distance& { return distances[at(a) * at(n) + at(b)]; };
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) between(a, b) = between(b, a) = distance_between(markers, a, b);
  const auto shielded = [&](int a, int b) {
    for (int c = 0; c < n; ++c)
      if (c != a && c != b && between(a, c).mean > 0 && between(b, c).mean > 0 &&
          std::max(between(a, c).mean, between(b, c).mean) < between(a, b).mean)
        return true;
    return false;
  };
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      if (between(a, b).rigid && !shielded(a, b)) pairs.emplace_back(a, b);
  return pairs;
}

bool looks_z_up(const MarkerSet& markers) {
  constexpr Index kFrames = 15;
  constexpr int kLeastMarkers = 10;
  Index along_z = 0, counted = 0;
  const Index looked_at = std::min(kFrames, markers.num_frames());
  for (Index k = 0; k < looked_at; ++k) {
    const Index t = k * (markers.num_frames() - 1) / std::max<Index>(1, looked_at - 1);
    Eigen::AlignedBox3d box;
    int num_seen = 0;
    for (int m = 0; m < markers.num_markers(); ++m)
      if (markers.seen(t, m)) box.extend(markers.position(t, m)), ++num_seen;
    if (num_seen < kLeastMarkers) continue;
    ++counted;
    const Vector3 extent = box.sizes();
    if (extent.z() > 1.25 * std::max(extent.x(), extent.y())) ++along_z;
  }
  return counted > 0 && 2 * along_z > counted;
}

}  // namespace motex
