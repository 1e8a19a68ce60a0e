// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/background.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"

namespace motex {
namespace {

/// A sharp grid with a white ball that crosses it; shift moves the grid: a camera that turns.
std::vector<Planes> crossing(int num_frames, int shift) {
  std::vector<Planes> frames;
  for (int t = 0; t < num_frames; ++t) {
    Plane frame(60, 40);
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 60; ++x) {
        const int stripe = (x + shift * t) / 2 % 2;
        frame.at(x, y) = std::hypot(x - 5 * t, y - 20) < 4 ? 250 : 60 + 40 * static_cast<float>(stripe);
      }
    frames.push_back({frame});
  }
  return frames;
}

float still(int x) { return 60 + 40 * static_cast<float>(x / 2 % 2); }

TEST(Background, MedianSeesThroughWhatPasses) {
  const std::vector<Planes> frames = crossing(11, 0);
  for (BackgroundKind kind : {BackgroundKind::kAuto, BackgroundKind::kMedian, BackgroundKind::kLow}) {
    const Planes background = estimate_background(frames[5], frames, kind);
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 60; ++x) ASSERT_EQ(background[0].at(x, y), still(x)) << name_of(kind);
    EXPECT_NE(kind, BackgroundKind::kAuto);
  }
}

TEST(Background, LowSeesThroughWhatCoversHalfTheTime) {
  std::vector<Planes> frames;
  for (int t = 0; t < 10; ++t) frames.push_back({Plane(3, 3, t < 6 ? 200 : 20)});
  EXPECT_EQ(quantile_over_time(frames, 0.5)[0].at(1, 1), 200);
  BackgroundKind low = BackgroundKind::kLow;
  EXPECT_EQ(estimate_background(frames[0], frames, low)[0].at(1, 1), 20);
}

TEST(Background, AutoTurnsSmoothForAMovingCameraAndSinglePictures) {
  std::vector<Planes> frames;
  for (int t = 0; t < 9; ++t) {
    Plane frame(60, 40);
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 60; ++x) frame.at(x, y) = 128 + 100 * std::sin(static_cast<float>(x + 12 * t) / 25);
    frames.push_back({frame});
  }
  BackgroundKind kind = BackgroundKind::kAuto;
  estimate_background(frames[4], frames, kind);
  EXPECT_EQ(kind, BackgroundKind::kSmooth);
  kind = BackgroundKind::kAuto;
  estimate_background(frames[0], {frames[0]}, kind);
  EXPECT_EQ(kind, BackgroundKind::kSmooth);
}

TEST(Background, FlatIsTheMean) {
  Plane ramp(3, 1);
  ramp.values = {0, 3, 9};
  BackgroundKind kind = BackgroundKind::kFlat;
  EXPECT_EQ(estimate_background({ramp}, {}, kind)[0].values, std::vector<float>(3, 4));
  EXPECT_THROW(quantile_over_time({}, 0.5), InvalidInput);
  EXPECT_THROW(estimate_background({ramp}, {{Plane(2, 1)}}, kind), InvalidInput);
}

}  // namespace
}  // namespace motex
