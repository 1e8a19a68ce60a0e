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
  EXPECT_EQ(wanted.distance(wanted), 0);
  MotionTally faster(4), elsewhere(4), fewer(4);
  for (int t = 0; t < 10; ++t) faster.add_element(3, 0.15);
  faster.add_frames(5);
  EXPECT_NEAR(faster.distance(wanted), 1, 1e-12) << "no speed in common";
  for (int t = 0; t < 10; ++t) elsewhere.add_element(-0.1, 2);
  elsewhere.add_frames(5);
  EXPECT_NEAR(elsewhere.distance(wanted), 1, 1e-12);
  for (int t = 0; t < 5; ++t) fewer.add_element(2, 0.1);
  fewer.add_frames(5);
  EXPECT_NEAR(fewer.distance(wanted), 1, 1e-12) << "half as many, counted twice";
  fewer.fade(0.5);
  EXPECT_NEAR(fewer.distance(wanted), 1, 1e-12) << "shares stay";
  fewer.add(wanted);
  EXPECT_NEAR(fewer.distance(wanted), 2.0 / 3 * 0.5, 1e-12) << "12.5 in 7.5 frames, 2 wanted";
}

}  // namespace
}  // namespace motex
