// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/marker_figure.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/lowered.h"

namespace motex {
namespace {

constexpr double kMarkerRadius = 0.011, kStickRadius = 0.0022;  // shares of the height

char other_side(char c) {
  switch (c) {
    case 'L':
      return 'R';
    case 'R':
      return 'L';
    case 'l':
      return 'r';
    case 'r':
      return 'l';
    default:
      return '\0';
  }
}

/// The first marker of that side whose name holds one of the words, earlier words first; −1 when there is none.
int find_marker(const MarkerSet& markers, Side side, std::initializer_list<const char*> words) {
  for (const char* word : words)
    for (int m = 0; m < markers.num_markers(); ++m)
      if (lowered(markers.names[static_cast<std::size_t>(m)]).find(word) != std::string::npos &&
          side_of_marker(markers, m) == side)
        return m;
  return -1;
}

/// From the floor to the highest marker, in most frames: that of a person who stands is 1.7 m when nobody knows.
double height_of(const MarkerSet& markers) {
  const double floor = floor_height(markers.positions);
  std::vector<double> tops;
  for (Index t = 0; t < markers.num_frames(); ++t) {
    double top = floor;
    for (int m = 0; m < markers.num_markers(); ++m)
      if (markers.seen(t, m)) top = std::max(top, markers.position(t, m).y());
    tops.push_back(top - floor);
  }
  if (tops.empty()) return 1;
  const auto at = tops.begin() + static_cast<std::ptrdiff_t>(tops.size() / 2);
  std::nth_element(tops.begin(), at, tops.end());
  return *at > 0 ? *at : 1;
}

}  // namespace

Side side_of_marker(const MarkerSet& markers, int marker) {
  const std::string& name = markers.names[static_cast<std::size_t>(marker)];
  for (const std::size_t at : {std::size_t{0}, name.size() - 1}) {
    const char other = other_side(name[at]);
    if (other == '\0') continue;
    std::string mirrored = name;
    mirrored[at] = other;
    if (std::find(markers.names.begin(), markers.names.end(), mirrored) != markers.names.end())
      return name[at] == 'L' || name[at] == 'l' ? Side::kLeft : Side::kRight;
  }
  return side_of_name(name);
}

FigureMotion figure_motion(const MarkerSet& markers) {
  check_markers(markers);
  FigureMotion motion{markers.name, markers.frame_time_secs, {}, markers.positions};
  Figure& figure = motion.figure;
  figure.num_points = markers.num_markers();
  figure.height = markers.metres_per_unit > 0 ? 1.7 / markers.metres_per_unit : height_of(markers);
  for (const auto& [first, second] : rigid_pairs(markers))
    figure.parts.push_back(
        {{{first, kStickRadius * figure.height}, {second, kStickRadius * figure.height}}, Side::kMiddle});
  for (int m = 0; m < markers.num_markers(); ++m)
    figure.parts.push_back({{{m, kMarkerRadius * figure.height}}, side_of_marker(markers, m)});
  for (const auto& [s, side] : {std::pair{0U, Side::kLeft}, {1U, Side::kRight}}) {
    figure.hips[s] = find_marker(markers, side, {"asi", "fwt", "hip", "psi"});
    figure.shoulders[s] = find_marker(markers, side, {"sho", "acro"});
    figure.hands[s] = find_marker(markers, side, {"wri", "wra", "wrb", "hand", "fin"});
    figure.feet[s] = find_marker(markers, side, {"ank", "hee", "foot", "toe"});
  }
  return motion;
}

}  // namespace motex
