// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/shots.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

constexpr int kWidth = 192, kHeight = 108;

/// A body that swings before a green screen with noise.
Image frame_of(double phase, Rng& rng, double light = 0) {
  Image image(kWidth, kHeight);
  const double swing = 30 * std::sin(phase);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool body = std::abs(x - 96 - swing * (100 - y) / 100.0) < 12 && y > 20;
      const double noise = light + 2 * rng.normal();
      const auto level = [&](double v) { return static_cast<std::uint8_t>(std::clamp(v + noise, 0.0, 255.0)); };
      image.at(x, y) = body ? Rgba{level(120), level(60), level(50), 255} : Rgba{level(40), level(180), level(60), 255};
    }
  return image;
}

TEST(ShotFinder, FindsACutBetweenTwoViewsOfOneActorAndNothingElse) {
  Rng rng(1);
  ShotFinder finder(25);
  for (int t = 0; t < 40; ++t) finder.add(frame_of(0.15 * t, rng));
  for (int t = 0; t < 40; ++t) finder.add(frame_of(0.15 * t + 4, rng));
  const ShotReport found = finder.finish();
  ASSERT_EQ(found.shots.size(), 2U);
  EXPECT_EQ(found.shots[0], (FrameSpan{0, 40}));
  EXPECT_EQ(found.shots[1], (FrameSpan{40, 40}));
  EXPECT_TRUE(found.flashes.empty());
}

TEST(ShotFinder, FastMotionAndLostFramesAreNoCuts) {
  Rng rng(2);
  ShotFinder finder(25);
  for (int t = 0; t < 90; ++t) {
    if (t == 41 || t == 60) continue;
    finder.add(frame_of(3 * std::sin(0.12 * t), rng));
  }
  EXPECT_EQ(finder.finish().shots.size(), 1U);
}

TEST(ShotFinder, WhiteAndBlackFlashesAreNoCutsUnlessTheViewChangesUnderThem) {
  Rng rng(3);
  ShotFinder finder(25);
  for (int t = 0; t < 120; ++t) {
    const bool white = t == 30 || (t >= 50 && t < 54), black = t == 80 || t == 81;
    finder.add(frame_of(0.15 * t + (t > 51 ? 4 : 0), rng, white ? 200 : black ? -150 : 0));
  }
  const ShotReport found = finder.finish();
  ASSERT_EQ(found.shots.size(), 2U);
  EXPECT_EQ(found.shots[1].start, 54);
  ASSERT_EQ(found.flashes.size(), 3U);
  EXPECT_EQ(found.flashes[1], (FrameSpan{50, 4}));
}

TEST(ShotFinder, FewFramesAreOneShotAndSizesMustNotChange) {
  Rng rng(4);
  EXPECT_TRUE(ShotFinder(25).finish().shots.empty());
  ShotFinder finder(25);
  finder.add(frame_of(0, rng));
  EXPECT_THROW(finder.add(Image(10, 10)), InvalidInput);
  const ShotReport found = finder.finish();
  ASSERT_EQ(found.shots.size(), 1U);
  EXPECT_EQ(found.shots[0], (FrameSpan{0, 1}));
}

}  // namespace
}  // namespace motex
