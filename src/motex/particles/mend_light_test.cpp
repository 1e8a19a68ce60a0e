// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/mend_light.h"

#include <gtest/gtest.h>

#include "motex/particles/clip_background.h"

namespace motex {
namespace {

constexpr int kSide = 40;

Cable standing(double x, double coefficient, int num_frames) {
  Cable cable;
  cable.core.assign(static_cast<std::size_t>(num_frames),
                    {BaseKind::kGaussian, x, 20, 2, 0, {static_cast<float>(coefficient), 0, 0}});
  return cable;
}

/// What of the light of `truth` the cables leave, a frame.
std::vector<double> left_of(std::vector<Plane> light, const std::vector<Cable>& cables) {
  subtract_cables(light, cables, 1);
  std::vector<double> squares;
  for (const Plane& plane : light) squares.push_back(sum_of_squares(plane));
  return squares;
}

TEST(MendLight, SharedLightIsNotPaintedTwiceAndUnseenElementsGiveTheirsUp) {
  std::vector<Plane> light(2, Plane(kSide, kSide));
  subtract_cables(light, {standing(10, -100, 2)}, 1);  // one element at 10, two frames
  std::vector<Cable> cables{standing(10, 100, 1), standing(10.2, 95, 1), standing(9.8, 105, 1), standing(30, 100, 1)};
  std::vector<Cable> second{standing(10, 90, 1)};
  second[0].first_frame = 1;  // a fair one: stays
  cables.push_back(second[0]);
  const std::vector<double> alone = left_of(light, {});
  EXPECT_GT(left_of(light, cables)[0], 4 * alone[0]);
  mend_light(light, cables, 1);
  EXPECT_LT(left_of(light, cables)[0], 0.01 * alone[0]);
  EXPECT_EQ(cables[4].core[0].coefficients[0], 90);
  EXPECT_NEAR(cables[3].core[0].coefficients[0], 2, 0.1) << "not there in the frame";
  for (const Cable& cable : cables) EXPECT_GT(cable.core[0].coefficients[0], 0);
}

TEST(MendLight, DarkElementsStayDark) {
  std::vector<Plane> light(1, Plane(kSide, kSide));
  std::vector<Cable> cables{standing(10, -100, 1), standing(200, -100, 1)};  // the second outside the picture
  mend_light(light, cables, 1);
  EXPECT_NEAR(cables[0].core[0].coefficients[0], -2, 0.1);
  EXPECT_EQ(cables[1].core[0].coefficients[0], -100);
}

}  // namespace
}  // namespace motex
