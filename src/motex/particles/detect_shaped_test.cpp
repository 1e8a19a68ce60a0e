// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/detect_shaped.h"

#include <gtest/gtest.h>

#include <cmath>

namespace motex {
namespace {

/// A body and two wings that are up or down.
void add_bird(Plane& plane, double x, double y, double scale, double amplitude, bool is_up, double turn = 0) {
  const auto add = [&](double cx, double cy, double s, double a) {
    for (int row = 0; row < plane.height; ++row)
      for (int column = 0; column < plane.width; ++column)
        plane.row(row)[column] += static_cast<float>(
            a * std::exp(-0.5 * ((column - cx) * (column - cx) + (row - cy) * (row - cy)) / (s * s)));
  };
  add(x, y, scale, amplitude);
  for (const double side : {-1.0, 1.0}) {
    const double u = 2.2 * side * scale, v = (is_up ? -1.6 : 1.6) * scale;
    add(x + std::cos(turn) * u - std::sin(turn) * v, y + std::sin(turn) * u + std::cos(turn) * v, 0.7 * scale,
        0.7 * amplitude);
  }
}

struct Flock {
  std::vector<Plane> frames;
  std::vector<std::vector<Blob>> blobs;
  std::vector<SightChain> chains;
};

/// Birds far apart that flap and fly on, leaning as they climb or sink, as blobs of their bodies.
Flock flock(double lean = 0) {
  Flock out;
  out.chains.resize(3);
  for (int t = 0; t < 30; ++t) {
    Plane& plane = out.frames.emplace_back(200, 60);
    std::vector<Blob>& blobs = out.blobs.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const double turn = (k - 1) * lean, x = 25 + 60 * k + 0.7 * t, shake = t / 2 % 2 == 0 ? -0.6 : 0.6;
      const double y = 30 + (lean == 0 ? 3 * std::sin(0.2 * t + k) : 0.7 * (t - 15) * std::tan(turn));
      add_bird(plane, x, y, 2, 80, t / 2 % 2 == 0, turn);
      blobs.push_back({x, y + shake, std::log(2.0), 0, 0, 80});  // wings shake the ellipse
      SightChain& chain = out.chains[static_cast<std::size_t>(k)];
      chain.sights.push_back({x, y + shake, std::log(80.0), std::log(2.0), 0, 0, 0, t});
      chain.idx.push_back(k);
    }
  }
  return out;
}

TEST(ElementShapes, WingsDoNotShakeTheBody) {
  const Flock birds = flock();
  const ElementShapes shapes = learn_element_shapes(birds.frames, birds.blobs, birds.chains, 1);
  ASSERT_FALSE(shapes.shapes.empty());
  EXPECT_GT(shapes.explained, 0.97);
  EXPECT_NEAR(std::exp(shapes.core.log_scale + shapes.mean_log_scale), 2, 0.5);
  DetectOptions options;
  options.sign = CoreSign::kBright;
  options.shape = CoreShape::kRound;
  for (const bool is_up : {true, false}) {
    Plane one(200, 60);
    add_bird(one, 100.3, 29.6, 2, 80, is_up);
    const std::vector<Blob> found = detect_shaped_blobs(one, shapes, options, 1, {});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].x, 100.3, 0.25);
    EXPECT_NEAR(found[0].y, 29.6, 0.35) << is_up;
  }
}

TEST(ElementShapes, OnesThatLeanAreOfTheSameShape) {
  const Flock birds = flock(0.45);
  const ElementShapes shapes = learn_element_shapes(birds.frames, birds.blobs, birds.chains, 1);
  ASSERT_FALSE(shapes.shapes.empty());
  EXPECT_GT(shapes.turn_deviation, 0.11);
  DetectOptions options;
  options.sign = CoreSign::kBright;
  options.shape = CoreShape::kRound;
  Plane one(200, 60);  // leaning as none that was learned from
  add_bird(one, 100.3, 29.6, 2, 80, true, 0.2);
  Plane left;
  const std::vector<Blob> found = detect_shaped_blobs(one, shapes, options, 1, {}, &left);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].x, 100.3, 0.5);
  EXPECT_NEAR(found[0].y, 29.6, 0.6);
  EXPECT_LT(sum_of_squares(left), 0.06 * sum_of_squares(one));
}

TEST(ElementShapes, TwoWhoseWingsOverlapAreTwo) {
  const Flock birds = flock();
  const ElementShapes shapes = learn_element_shapes(birds.frames, birds.blobs, birds.chains, 1);
  DetectOptions options;
  options.sign = CoreSign::kBright;
  options.shape = CoreShape::kRound;
  Plane two(200, 60);
  add_bird(two, 95, 28, 2, 80, true);
  add_bird(two, 103, 31, 2, 80, false);
  const std::vector<Blob> found = detect_shaped_blobs(two, shapes, options, 1, {});
  ASSERT_EQ(found.size(), 2U);
  const std::size_t left = found[0].x < found[1].x ? 0 : 1;
  EXPECT_NEAR(found[left].x, 95, 0.5);
  EXPECT_NEAR(found[left].y, 28, 0.6);
  EXPECT_NEAR(found[1 - left].x, 103, 0.5);
  EXPECT_NEAR(found[1 - left].y, 31, 0.6);
}

TEST(ElementShapes, SightsSayHowFarShapesDiffer) {
  const Flock birds = flock();
  const ElementShapes shapes = learn_element_shapes(birds.frames, birds.blobs, birds.chains, 1);
  DetectOptions options;
  options.sign = CoreSign::kBright;
  options.shape = CoreShape::kRound;
  Plane alone(200, 60), two(200, 60);
  add_bird(alone, 95, 28, 2, 80, true);
  add_bird(two, 95, 28, 2, 80, true);
  add_bird(two, 103, 31, 2, 80, false);
  const std::vector<Blob> one = detect_shaped_blobs(alone, shapes, options, 1, {});
  const std::vector<Blob> both = detect_shaped_blobs(two, shapes, options, 1, {});
  ASSERT_EQ(one.size(), 1U);
  ASSERT_EQ(both.size(), 2U);
  // The states of one bird differ by more than the noise: its sights must stay one path.
  EXPECT_GT(one[0].log_scale_spread, 0.05);
  EXPECT_GT(one[0].amplitude_spread, 0.05 * std::abs(one[0].amplitude));
  EXPECT_GT(one[0].place_spread, 0.05 * one[0].scale());
  for (const Blob& blob : both) EXPECT_GT(blob.place_spread, 1.5 * one[0].place_spread);
}

TEST(ElementShapes, FewElementsTeachNone) {
  Flock birds = flock();
  birds.chains.resize(1);
  birds.frames.resize(20);
  birds.blobs.resize(20);
  birds.chains[0].sights.resize(20);
  birds.chains[0].idx.resize(20);
  EXPECT_TRUE(learn_element_shapes(birds.frames, birds.blobs, birds.chains, 1).shapes.empty());
}

}  // namespace
}  // namespace motex
