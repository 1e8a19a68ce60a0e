// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/track_overlay.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/plot/colour.h"

namespace motex {
namespace {

std::vector<Track> one_track() { return {{3, {{2, 10, 20, 2, 0, 80}, {3, 20, 20, 2, 0, 80}, {4, 30, 20, 2, 0, 80}}}}; }

bool coloured(const Image& image, int x, int y) {
  const Rgba pixel = image.at(x, y);
  return pixel.r != pixel.g || pixel.g != pixel.b;
}

TEST(TrackOverlay, RingsTheElementAndTrailsBehindIt) {
  const TrackOverlay overlay(one_track(), 240, 40);
  ASSERT_EQ(overlay.magnification(), 4);
  const Image grey(240, 40, {90, 90, 90, 255});
  const auto marked = [&](int frame, double x, double y) {
    return coloured(overlay.draw(grey, frame), static_cast<int>((x + 0.5) * 4), static_cast<int>((y + 0.5) * 4));
  };
  EXPECT_TRUE(marked(3, 24, 20)) << "the ring, radius 2 scales";
  EXPECT_FALSE(marked(3, 20, 22)) << "inside of the ring";
  EXPECT_TRUE(marked(3, 15, 20)) << "the trail";
  EXPECT_FALSE(marked(3, 27, 20)) << "the future";
  EXPECT_FALSE(marked(1, 10, 16)) << "before birth";
  EXPECT_FALSE(marked(5, 25, 20)) << "after death";
}

TEST(TrackOverlay, PicturesOfAnotherSizeAreRefused) {
  EXPECT_THROW(TrackOverlay(one_track(), 64, 40).draw(Image(65, 40), 0), InvalidInput);
}

}  // namespace
}  // namespace motex
