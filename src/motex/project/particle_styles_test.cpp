// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/particle_styles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/image/contour.h"
#include "motex/project/moveton_shape.h"

namespace motex {
namespace {

Base blob(double x, double y, double scale, double amplitude) {
  Base base{BaseKind::kGaussian, x, y, scale, 0, {}};
  base.coefficients[0] = static_cast<float>(coefficient_of_peak(base, amplitude));
  return base;
}

constexpr int kFrames = 5;

/// A bright flake that falls by a pixel a frame from (30, 10) on grey.
TexturedMotion one_flake() {
  TexturedMotion model;
  model.width = 60;
  model.height = 50;
  model.background = {Plane(60, 50, 60)};
  Cable cable;
  for (int t = 0; t < kFrames; ++t) cable.core.push_back(blob(30, 10 + t, 2, 150));
  model.cables.push_back(cable);
  return model;
}

MovetonFrame frame_of(const Base& core, std::int64_t t = 0) {
  MovetonFrame frame;
  frame.frame = t;
  Moveton moveton;
  moveton.track = 3;
  moveton.vy = 1;
  frame.movetons = {moveton};
  frame.bases = {core};
  return frame;
}

struct Painted {
  Image picture, layer;
};

Painted paint(StylePainter& painter, const MovetonFrame& frame) {
  Painted painted;
  painter.paint(frame, painted.picture, painted.layer);
  return painted;
}

double area(const std::vector<Point>& points) {
  Contour contour;
  for (const Point& p : points) contour.push_back({p.x, p.y});
  return std::abs(signed_area(contour));
}

double covered(const Image& layer) {
  double sum = 0;
  for (const Rgba& pixel : layer.pixels) sum += pixel.a / 255.0;
  return sum;
}

TEST(ParticleStyles, RefusesWrongMagnifications) {
  const TexturedMotion model = one_flake();
  EXPECT_THROW(StylePainter(model, DrawnStyle::kCartoon, 0), InvalidInput);
  EXPECT_THROW(StylePainter(model, DrawnStyle::kSymbolic, 100), InvalidInput);
}

TEST(ParticleStyles, CartoonIsAFlatDiscWhereTheElementIs) {
  const TexturedMotion model = one_flake();
  StylePainter painter(model, DrawnStyle::kCartoon, 2);
  ASSERT_EQ(painter.width(), 120);
  const Painted frame = paint(painter, frame_of(model.cables[0].core[2]));
  EXPECT_GT(frame.picture.at(61, 25).r, 180);  // flake at (30, 12): its middle at (30.5, 12.5) · 2
  EXPECT_EQ(frame.picture.at(10, 90).r, 60);   // the background
  EXPECT_EQ(frame.layer.at(10, 90).a, 0);
  EXPECT_EQ(frame.layer.at(61, 25).a, 255);
  const double radius = 3 * 2 + 0.7;  // with half of the outline
  EXPECT_NEAR(covered(frame.layer), 3.1416 * radius * radius, 5);
  EXPECT_EQ(covered(paint(painter, {}).layer), 0);
}

TEST(ParticleStyles, FastBlobsAreDropsWithTheTailBehind) {
  const std::vector<Point> slow = drop_outline({0, 0}, 2, 0, 3), fast = drop_outline({0, 0}, 2, 0, 9);
  EXPECT_NEAR(area(slow), 3.1416 * 4, 0.3);
  double front = 0, back = 0;
  for (const Point& p : fast) {
    front = std::max(front, p.y);
    back = std::min(back, p.y);
    EXPECT_LE(std::abs(p.x), 2.001);
  }
  EXPECT_GT(-back, front + 1);
  EXPECT_NEAR(front - back, 11, 0.5);  // the way of a frame and the head
}

TEST(ParticleStyles, ShapeOfBasesFollowsTheWings) {
  // A body and two wings that are up: the shape reaches higher beside the body than above it.
  const std::vector<Base> bases{blob(20, 20, 2, -90), blob(16, 17, 1.5, -70), blob(24, 17, 1.5, -70)};
  const std::vector<std::vector<Point>> outlines = shape_of_bases(bases);
  ASSERT_EQ(outlines.size(), 1U);
  double wing = HUGE_VAL, middle = HUGE_VAL, below = 0;
  for (const Point& p : outlines[0]) {
    if (std::abs(p.x - 24.5) < 1) wing = std::min(wing, p.y);
    if (std::abs(p.x - 20.5) < 0.7) middle = std::min(middle, p.y);
    below = std::max(below, p.y);
  }
  EXPECT_LT(wing, middle - 1);
  EXPECT_NEAR(below, 20.5 + 2 * std::sqrt(-2 * std::log(0.4)), 0.8);
}

TEST(ParticleStyles, SymbolsAreOnWhitePaper) {
  const TexturedMotion model = one_flake();
  StylePainter painter(model, DrawnStyle::kSymbolic, 2);
  const Painted frame = paint(painter, frame_of(model.cables[0].core[2]));
  EXPECT_EQ(frame.picture.at(10, 90), (Rgba{255, 255, 255, 255}));
  EXPECT_LT(frame.picture.at(61, 25).r, 60);
  EXPECT_GT(frame.layer.at(61, 25).a, 200);
  EXPECT_EQ(frame.layer.at(10, 90).a, 0);
}

TEST(ParticleStyles, DarkBirdsBeforeGreenAreDark) {  // red does not change there: what counts is the luma
  TexturedMotion model = one_flake();
  model.num_planes = 3;
  model.background = {Plane(60, 50, 0), Plane(60, 50, 250), Plane(60, 50, 0)};
  Base core = blob(30, 20, 2, -200);
  const float green = core.coefficients[0];
  core.coefficients = {-0.001F * green, green, 0};
  model.cables[0].core = {core};
  for (const DrawnStyle style : {DrawnStyle::kCartoon, DrawnStyle::kSymbolic}) {
    StylePainter painter(model, style);
    const Image layer = paint(painter, frame_of(core)).layer;
    EXPECT_GT(layer.at(30, 20).a, 200);
    EXPECT_LT(layer.at(30, 20).g, 100);
  }
}

TEST(ParticleStyles, FadingElementsShrink) {
  const TexturedMotion model = one_flake();
  StylePainter painter(model, DrawnStyle::kCartoon);
  const double whole = covered(paint(painter, frame_of(blob(30, 20, 2, 150), 0)).layer);
  EXPECT_LT(covered(paint(painter, frame_of(blob(30, 20, 2, 40), 1)).layer), 0.6 * whole);
  paint(painter, {});  // gone: what comes next with its number is another one
  EXPECT_NEAR(covered(paint(painter, frame_of(blob(30, 20, 2, 40), 3)).layer), whole, 1e-9);
}

}  // namespace
}  // namespace motex
