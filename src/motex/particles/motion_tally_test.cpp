// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/motion_tally.h"

#include <gtest/gtest.h>

namespace motex {
namespace {

TEST(MotionTally, TellsSpeedDirectionAndNumberApart) {
  MotionTally wanted(4);
  for (int t = 0; t < 10; ++t) wanted.add_element(2, 0.1);
  wanted.add_frames(5);
  EXPECT_EQ(wanted.difference(wanted).speed, 0);
  EXPECT_EQ(wanted.difference(wanted).direction, 0);
  EXPECT_EQ(wanted.difference(wanted).count, 0);
  MotionTally faster(4), elsewhere(4), fewer(4);
  for (int t = 0; t < 10; ++t) faster.add_element(3, 0.15);
  faster.add_frames(5);
  EXPECT_NEAR(faster.difference(wanted).speed, 1, 1e-12) << "no speed in common";
  EXPECT_NEAR(faster.difference(wanted).direction, 0, 1e-12);
  for (int t = 0; t < 10; ++t) elsewhere.add_element(-0.1, 2);
  elsewhere.add_frames(5);
  EXPECT_NEAR(elsewhere.difference(wanted).speed, 0, 1e-12);
  EXPECT_NEAR(elsewhere.difference(wanted).direction, 1, 1e-12);
  for (int t = 0; t < 5; ++t) fewer.add_element(2, 0.1);
  fewer.add_frames(5);
  EXPECT_NEAR(fewer.difference(wanted).count, -0.5, 1e-12);
  fewer.add(wanted, 0.5);
  EXPECT_NEAR(fewer.difference(wanted).count, -1.0 / 3, 1e-12) << "10 in 7.5 frames, 2 wanted";
  fewer.add(elsewhere);
  EXPECT_NEAR(fewer.difference(wanted).direction, 0.5, 1e-12) << "half of them go elsewhere";
  fewer.add(elsewhere, -1);
  EXPECT_NEAR(fewer.difference(wanted).direction, 0, 1e-12);
}

}  // namespace
}  // namespace motex
