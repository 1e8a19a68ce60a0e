// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/signals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

/// Breathes once in 20 frames; mu30 is nothing but noise.
PeopleTexture breathing(int num_frames) {
  PeopleTexture texture;
  texture.width = 320, texture.height = 240, texture.frames_per_sec = 25;
  Rng rng(3);
  for (int t = 0; t < num_frames; ++t) {
    const double s = std::sin(2 * std::numbers::pi * t / 20);
    Silhouette one;
    one.box = {100, 50, 100 + 49 + static_cast<int>(std::lround(10 * s)), 149};
    one.area = 3000 + 300 * s, one.centroid_x = 125 + 3 * s, one.centroid_y = 100 + s;
    one.mu20 = 0.1 + 0.02 * s, one.mu02 = 0.3 - 0.02 * s, one.mu11 = 0.01 * s, one.mu30 = 0.001 * rng.normal();
    texture.silhouettes.push_back(one);
  }
  texture.takes = {{"a.mp4", 0, 0, false, {0, num_frames}}};
  return texture;
}

void forget(PeopleTexture& texture, int first, int last) {
  for (int t = first; t <= last; ++t) texture.silhouettes[static_cast<std::size_t>(t)] = {};
}

TEST(MeasureSignals, RefusesNobodyAndTakesThatDisagree) {
  PeopleTexture texture = breathing(50);
  texture.takes[0].frames.length = 49;
  EXPECT_THROW(measure_signals(texture), InvalidInput);
  texture.takes[0].frames.length = 50;
  forget(texture, 0, 49);
  EXPECT_THROW(measure_signals(texture), InvalidInput);
}

TEST(MeasureSignals, AspectIsWidthThroughHeight) {
  const PeopleSignals found = measure_signals(breathing(50));
  EXPECT_DOUBLE_EQ(signal_named(found, "aspect").values[5], 60.0 / 100);
  EXPECT_EQ(signal_named(found, "area").unit, "px²");
  ASSERT_EQ(found.stretches.size(), 1U);
  EXPECT_EQ(found.stretches[0], (FrameSpan{0, 50}));
  EXPECT_THROW(signal_named(found, "colour"), InvalidInput);
}

TEST(MeasureSignals, ShortGapsAreBridgedLongOnesEndAStretchAndTakesAreNeverJoined) {
  PeopleTexture texture = breathing(100);
  texture.takes = {{"a.mp4", 0, 0, false, {0, 60}}, {"b.mp4", 0, 0, false, {60, 40}}};
  forget(texture, 0, 1);
  forget(texture, 10, 12);
  forget(texture, 30, 40);
  forget(texture, 59, 60);
  const PeopleSignals found = measure_signals(texture);
  ASSERT_EQ(found.stretches.size(), 3U);
  EXPECT_EQ(found.stretches[0], (FrameSpan{2, 28}));
  EXPECT_EQ(found.stretches[1], (FrameSpan{41, 18}));
  EXPECT_EQ(found.stretches[2], (FrameSpan{61, 39}));
  ASSERT_EQ(found.bridged.size(), 1U);
  EXPECT_EQ(found.bridged[0], (FrameSpan{10, 3}));
  const std::vector<double>& area = signal_named(found, "area").values;
  EXPECT_NEAR(area[11], (area[9] + area[13]) / 2, 1e-9);
  EXPECT_TRUE(std::isnan(area[35]));
}

TEST(MeasureSignals, SmoothingStaysInsideAStretch) {
  PeopleTexture texture = breathing(100);
  for (std::size_t t = 50; t < 100; ++t) texture.silhouettes[t].area += 1e5;
  texture.takes = {{"a.mp4", 0, 0, false, {0, 50}}, {"a.mp4", 70, 0, false, {50, 50}}};
  SignalOptions options;
  options.smooth_secs = 0.08;
  const std::vector<double> area = signal_named(measure_signals(texture, options), "area").values;
  EXPECT_LT(area[49], 4000);
  EXPECT_GT(area[50], 1e5);
  EXPECT_LT(area[5], 3299) << "the peak gets lower";
}

TEST(DefaultMotifSignals, WhatIsOnlyNoiseIsLeftOut) {
  const MotifSignals found = default_motif_signals(breathing(200));
  ASSERT_EQ(found.signals.size(), 8U);
  for (std::size_t k = 0; k < found.signals.size(); ++k) {
    const std::string& name = found.signals[k].name;
    const bool moves = name != "mu30" && name != "mu21" && name != "mu03";
    EXPECT_EQ(found.weights[k] > 0, moves) << name;
  }
  EXPECT_EQ(paper_motif_signals(breathing(50)).signals.size(), 1U);
}

TEST(DefaultMotifSignals, DoNotDependOnTheSizeOfThePicture) {
  const PeopleTexture small = breathing(100);
  PeopleTexture large = small;
  for (Silhouette& one : large.silhouettes) {
    one.area *= 4, one.centroid_x *= 2, one.centroid_y *= 2;
    one.box = {2 * one.box.left, 2 * one.box.top, 2 * one.box.right + 1, 2 * one.box.bottom + 1};
  }
  const MotifSignals a = default_motif_signals(small), b = default_motif_signals(large);
  for (std::size_t k = 0; k < a.signals.size(); ++k)
    EXPECT_NEAR(a.signals[k].values[7] - a.signals[k].values[0], b.signals[k].values[7] - b.signals[k].values[0], 1e-6);
}

}  // namespace
}  // namespace motex
