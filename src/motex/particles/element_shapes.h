// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "motex/particles/blob_fit.h"
#include "motex/particles/link_sights.h"

namespace motex {

/// A picture around the place of an element of scale 1 and amplitude 1, on a grid: value and its derivatives along u
/// and v, between the points bilinear, nothing outside.
class ShapeGrid {
 public:
  static constexpr int kSide = 41;
  static constexpr double kReach = 5;  ///< scales to each side of the place
  static constexpr double kSpacing = 2 * kReach / (kSide - 1);

  ShapeGrid() : points_(static_cast<std::size_t>(kSide) * kSide) {}
  /// values: kSide² of them, row by row. What does not hang together with the place (other elements) is left out; faded
  /// out at the rim.
  explicit ShapeGrid(const std::vector<float>& values);

  struct Point {
    float value = 0, along_u = 0, along_v = 0;
  };
  /// Nothing is further from the place, scales.
  double reach() const { return reach_; }
  /// All that is something lies between these, scales.
  struct Extent {
    double left = 0, top = 0, right = 0, bottom = 0;
  };
  const Extent& extent() const { return extent_; }
  Point at(double u, double v) const {
    const double column = (u + kReach) / kSpacing, row = (v + kReach) / kSpacing;
    if (!(column >= 0 && row >= 0 && column < kSide - 1 && row < kSide - 1)) return {};
    const int left = static_cast<int>(column), top = static_cast<int>(row);
    const auto fx = static_cast<float>(column - left), fy = static_cast<float>(row - top);
    const Point* p = points_.data() + top * kSide + left;
    const float a = (1 - fx) * (1 - fy), b = fx * (1 - fy), c = (1 - fx) * fy, d = fx * fy;
    const auto mix = [&](float Point::*field) {
      return a * (p[0].*field) + b * (p[1].*field) + c * (p[kSide].*field) + d * (p[kSide + 1].*field);
    };
    return {mix(&Point::value), mix(&Point::along_u), mix(&Point::along_v)};
  }

 private:
  void find_extent();

  double reach_ = kReach;
  std::vector<Point> points_;
  Extent extent_;
};

/// An element with parts in one frame: amplitude · shape(R(−turn) (p − (x, y)) / e^{log_scale}), R a rotation from the
/// x axis towards the y axis.
struct ShapedElement {
  double x = 0, y = 0, log_scale = 0, amplitude = 0;
  double turn = 0;  ///< radians
  int shape = 0;
  double place_spread = 0, log_scale_spread = 0, amplitude_spread = 0;  ///< deviations that the noise brings about
};

/// What is known of x, y, ln scale, amplitude and turn before the picture is looked at; precision 0 = nothing.
struct ShapedPrior {
  std::array<double, 5> mean{}, precision{};
};

/// How the elements of a clip look that are no single spots (birds): pictures of the states that they are seen in, all
/// with the core at their origin, and what is usual.
struct ElementShapes {
  std::vector<ShapeGrid> shapes;
  Blob core;  ///< of an element of scale 1 and amplitude 1
  double mean_log_scale = 0, log_scale_deviation = 1;
  double mean_amplitude = 0, amplitude_deviation = 1;
  double mean_turn = 0, turn_deviation = 0.1;
  double alone = 0;      ///< share of the sights that stand alone
  double noise = 1;      ///< deviation of a pixel from the elements learned from and background
  double explained = 0;  ///< share of their light

  /// Elements lean differently, so that their turns are fitted.
  bool are_turned() const { return turn_deviation > 0.01; }
};

/// Shapes from elements that stand alone: their pictures, scaled, in up to eight groups; places and turns are changed
/// until the pictures of a group agree, and groups are shifted until paths are smooth across a change of shape (a flap
/// of the wings must not shake the body). Turns begin with the direction of flight where pictures agree better then. No
/// shapes when fewer than 40 or 27 % stand alone. residuals: frames minus background; blobs: of each frame; chains:
/// their paths; noise: deviation of a pixel.
ElementShapes learn_element_shapes(const std::vector<Plane>& residuals, const std::vector<std::vector<Blob>>& blobs,
                                   const std::vector<SightChain>& chains, double noise);

}  // namespace motex
