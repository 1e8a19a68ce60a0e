// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "motex/core/error.h"

namespace motex {
namespace {

using Place = WarpGrid::Displacement;

/// A texture seen through p → p + u(p).
Plane texture(const std::function<Place(double, double)>& u) {
  Plane plane(120, 90);
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      const Place d = u(x, y);
      const double px = x + d.x, py = y + d.y;
      plane.at(x, y) = static_cast<float>(128 + 50 * std::sin(0.31 * px + 0.05 * py) + 40 * std::sin(0.27 * py) +
                                          20 * std::sin(0.7 * px - 0.5 * py));
    }
  }
  return plane;
}

/// Root mean square of flow − truth away from the edges.
double error_of(const WarpGrid& flow, const std::function<Place(double, double)>& truth, int right = 104) {
  double sum = 0, count = 0;
  for (int y = 16; y < 74; ++y) {
    for (int x = 16; x < right; ++x) {
      const Place found = flow.at(x, y), true_one = truth(x, y);
      sum += std::pow(found.x - true_one.x, 2) + std::pow(found.y - true_one.y, 2), ++count;
    }
  }
  return std::sqrt(sum / count);
}

const auto kStill = [](double, double) { return Place{}; };

TEST(OpticalFlow, RefusesPicturesOfDifferentSizes) {
  EXPECT_THROW(optical_flow({Plane(8, 8)}, {Plane(8, 9)}), InvalidInput);
  EXPECT_THROW(optical_flow({Plane(8, 8)}, {Plane(8, 8), Plane(8, 8)}), InvalidInput);
  EXPECT_THROW(optical_flow({}, {}), InvalidInput);
  EXPECT_THROW(optical_flow({Plane()}, {Plane()}), InvalidInput);
}

TEST(OpticalFlow, IsZeroBetweenEqualPicturesAndWithoutTexture) {
  EXPECT_LT(error_of(optical_flow({texture(kStill)}, {texture(kStill)}), kStill), 1e-6);
  EXPECT_LT(error_of(optical_flow({Plane(120, 90, 50)}, {Plane(120, 90, 60)}), kStill), 1e-6);
}

TEST(OpticalFlow, FindsAShift) {
  const auto moved = [](double, double) { return Place{-3.3, 1.6}; };
  const auto truth = [](double, double) { return Place{3.3, -1.6}; };
  EXPECT_LT(error_of(optical_flow({texture(kStill)}, {texture(moved)}), truth), 0.05);
}

TEST(OpticalFlow, FindsABend) {
  const auto bend = [](double x, double y) { return Place{1.5 * std::sin(0.05 * y), 1.2 * std::sin(0.06 * x)}; };
  // from(p + bend(p)) = to(p): the flow from `to` is the bend.
  EXPECT_LT(error_of(optical_flow({texture(bend)}, {texture(kStill)}), bend), 0.12);
}

TEST(OpticalFlow, AStartCarriesItOverARepeatingTexture) {
  const auto far = [](double, double) { return Place{-19.5, 0}; };
  const auto truth = [](double, double) { return Place{19.5, 0}; };
  const Planes from{texture(kStill)}, to{texture(far)};
  WarpGrid start(0, 0, 120, 90, 16);
  for (float& x : start.x) x = 18;
  EXPECT_LT(error_of(optical_flow(from, to, {}, &start), truth, 84), 0.1);
}

}  // namespace
}  // namespace motex
