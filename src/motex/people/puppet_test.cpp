// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/puppet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/people/puppet_stage.h"

namespace motex {
namespace {

/// All joints at one place: a figure that is a disc of its widest part.
PuppetPose heap(double x, double y, double pixels_per_metre) {
  PuppetPose pose;
  for (PuppetPoint& joint : pose.joints) joint = {x, y, 0, pixels_per_metre};
  return pose;
}

TEST(Puppet, RefusesFramesWithoutPixels) { EXPECT_THROW(draw_puppet(heap(1, 1, 10), {}, 0, 10), InvalidInput); }

TEST(Puppet, AlphaIsTheAreaOfTheFigure) {
  // A limb without length is a disc of its first radius; the head's 0.115 m is the largest.
  const double radius = 0.115 * 200;
  const Sprite sprite = draw_puppet(heap(50.3, 40.6, 200), {}, 100, 80);
  double area = 0, x = 0;
  for (int row = 0; row < sprite.height; ++row)
    for (int column = 0; column < sprite.width; ++column) {
      const double alpha = sprite.at(column, row)[3] / 255.0;
      area += alpha;
      x += alpha * (sprite.left + column);
    }
  EXPECT_NEAR(area / (std::numbers::pi * radius * radius), 1, 0.002);
  EXPECT_NEAR(x / area, 50.3, 0.02);
}

TEST(Puppet, ColoursStayBelowAlpha) {
  for (int look = 0; look < 4; ++look) {
    const Sprite sprite = draw_puppet(heap(50, 40, 200), puppet_look(look), 100, 80, {{45, 190, 55, 255}, 0.4});
    for (const PremultipliedRgba& pixel : sprite.pixels)
      for (std::size_t k = 0; k < 3; ++k) ASSERT_LE(pixel[k], pixel[3]);
  }
}

TEST(Puppet, SpillColoursTheRimOnly) {
  const PuppetPose pose = heap(50, 40, 200);
  const Sprite clean = draw_puppet(pose, {}, 100, 80),
               spilled = draw_puppet(pose, {}, 100, 80, {{0, 255, 0, 255}, 0.4});
  int rim = 0;
  while (clean.at(rim, clean.height / 2)[3] < 255) ++rim;
  EXPECT_GT(spilled.at(rim, spilled.height / 2)[1], clean.at(rim, clean.height / 2)[1] + 10);
  const PremultipliedRgba &a = clean.at(clean.width / 2, clean.height / 2),
                          &b = spilled.at(clean.width / 2, clean.height / 2);
  EXPECT_NEAR(a[1], b[1], 3);
}

TEST(Puppet, OutsideTheFrameIsCutOff) {
  EXPECT_TRUE(draw_puppet(heap(-500, 40, 200), {}, 100, 80).empty());
  const Sprite half = draw_puppet(heap(0, 40, 200), {}, 100, 80);
  EXPECT_EQ(half.left, 0);
  EXPECT_LT(half.width, 30);
}

TEST(PuppetStage, NoiseHasTheDeviationAskedFor) {
  const PuppetStage stage(320, 240, {ScreenColour::kPlain, 0, 0, 3, 5});
  Image frame = stage.screen();
  stage.add_noise(frame, 7);
  double sum = 0;
  for (std::size_t k = 0; k < frame.pixels.size(); ++k) {
    const double d = frame.pixels[k].g - stage.screen().pixels[k].g;
    sum += d * d;
  }
  EXPECT_NEAR(std::sqrt(sum / static_cast<double>(frame.pixels.size())), 3, 0.1);
  Image again = stage.screen(), other = stage.screen();
  stage.add_noise(again, 7);
  stage.add_noise(other, 8);
  EXPECT_EQ(again.pixels, frame.pixels);
  EXPECT_NE(other.pixels, frame.pixels);
}

TEST(PuppetStage, LightFallsOffTowardsTheEdges) {
  const PuppetStage stage(320, 240, {ScreenColour::kGreen, 0.3, 0, 0, 5});
  EXPECT_LT(stage.screen().at(0, 0).g, 0.7 * stage.screen().at(160, 110).g);
}

}  // namespace
}  // namespace motex
