// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/simplex_search.h"

#include <algorithm>
#include <cmath>

namespace motex {
namespace {

using Point = std::vector<double>;

struct Corner {
  Point point;
  double value = 0;
};

/// centre + weight (corner − centre)
Point along(const Point& centre, const Point& corner, double weight) {
  Point out(centre.size());
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = centre[k] + weight * (corner[k] - centre[k]);
  return out;
}

Point centre_of_all_but_last(const std::vector<Corner>& corners) {
  Point centre(corners[0].point.size(), 0.0);
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
    for (std::size_t k = 0; k < centre.size(); ++k) centre[k] += corners[i].point[k];
  for (double& value : centre) value /= static_cast<double>(corners.size() - 1);
  return centre;
}

}  // namespace

SimplexResult minimise_by_simplex(const std::function<double(const std::vector<double>&)>& function,
                                  const std::vector<double>& start, double step, double tolerance,
                                  int max_evaluations) {
  int evaluations = 0;
  const auto corner_at = [&](Point point) {
    ++evaluations;
    const double value = function(point);
    return Corner{std::move(point), std::isfinite(value) ? value : 1e300};
  };
  std::vector<Corner> corners{corner_at(start)};
  for (std::size_t k = 0; k < start.size(); ++k) {
    Point point = start;
    point[k] += step;
    corners.push_back(corner_at(std::move(point)));
  }
  const auto sort = [&] {
    std::stable_sort(corners.begin(), corners.end(),
                     [](const Corner& a, const Corner& b) { return a.value < b.value; });
  };
  sort();
  while (evaluations < max_evaluations && corners.back().value - corners.front().value > tolerance) {
    const Point centre = centre_of_all_but_last(corners);
    Corner& worst = corners.back();
    Corner mirrored = corner_at(along(centre, worst.point, -1));
    if (mirrored.value < corners.front().value) {
      Corner further = corner_at(along(centre, worst.point, -2));
      worst = further.value < mirrored.value ? std::move(further) : std::move(mirrored);
    } else if (mirrored.value < corners[corners.size() - 2].value) {
      worst = std::move(mirrored);
    } else {
      if (mirrored.value < worst.value) worst = std::move(mirrored);
      Corner nearer = corner_at(along(centre, worst.point, 0.5));
      if (nearer.value < worst.value) {
        worst = std::move(nearer);
      } else {
        for (std::size_t i = 1; i < corners.size(); ++i)
          corners[i] = corner_at(along(corners.front().point, corners[i].point, 0.5));
      }
    }
    sort();
  }
  return {corners.front().point, corners.front().value, evaluations};
}

}  // namespace motex
