// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/bird_flight.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "motex/core/error.h"
#include "motex/particles/bird_mesh.h"
#include "motex/particles/bird_painter.h"

namespace motex {
namespace {

TemplatePose wings_at(double height) {
  TemplatePose pose;
  for (const double side : {-1.0, 1.0}) {
    TemplateCoil coil;
    coil.u.mean = 2 * side;
    coil.v.mean = -height;
    coil.log_scale.mean = std::log(0.7);
    coil.coefficient[0].mean = 0.5;
    pose.coils.push_back(coil);
  }
  return pose;
}

/// Dark birds before a grey sky; poses: wings level, up, down.
TexturedMotion bird_model() {
  TexturedMotion model;
  model.width = 200;
  model.height = 120;
  model.background = {Plane(200, 120, 190)};
  MovetonTemplate birds;
  birds.poses = {wings_at(0), wings_at(1.5), wings_at(-1.5)};
  birds.pose_transitions = TransitionMatrix(3, 1);
  birds.amplitude.mean = -120;
  birds.colour.fill({1, 0});
  model.templates = {birds};
  return model;
}

MovetonFrame one_bird(std::int64_t t, double x, double y, double scale, int pose, double vx = 0, double vy = 0) {
  MovetonFrame frame;
  frame.frame = t;
  Moveton moveton;
  moveton.track = 7;
  moveton.species = 0;
  moveton.pose = pose;
  moveton.vx = vx;
  moveton.vy = vy;
  frame.movetons = {moveton};
  frame.bases = {Base{BaseKind::kGaussian, x, y, scale, 0, {-300, 0, 0}}};
  return frame;
}

TEST(BirdFlight, RefusesWrongRequests) {
  EXPECT_THROW(BirdFlock(TexturedMotion{}), InvalidInput);
  BirdFlightOptions options;
  options.field_of_view = 170;
  EXPECT_THROW(BirdFlock(bird_model(), options), InvalidInput);
}

TEST(BirdFlight, FollowerIsACriticallyDampedSpring) {
  Follower follower;
  for (int t = 1; t <= 30; ++t) {
    follower.step(1, 0.4);
    EXPECT_NEAR(follower.value, 1 - (1 + 0.4 * t) * std::exp(-0.4 * t), 1e-12);
  }
}

TEST(BirdFlight, StatesAreOrderedByWhereTheWingsLie) {
  const std::vector<double> angles = wing_angles(bird_model().templates[0], 0.8);
  ASSERT_EQ(angles.size(), 3U);
  EXPECT_NEAR(angles[0], 0, 1e-9);
  EXPECT_NEAR(angles[1], 0.8, 1e-9);
  EXPECT_NEAR(angles[2], -0.8, 1e-9);
}

TEST(BirdFlight, HalfTheSizeIsTwiceTheDepth) {
  BirdFlock flock(bird_model());
  const Vector3 near = flock.advance(one_bird(0, 150, 30, 4, 0))[0].position;
  BirdFlock other(bird_model());
  const Vector3 far = other.advance(one_bird(0, 150, 30, 2, 0))[0].position;
  EXPECT_NEAR(far.z() / near.z(), 2, 1e-9);
  EXPECT_LT(near.z(), 0);
  for (const Vector3& p : {near, far}) {  // both are seen where the moveton is
    EXPECT_NEAR(0.5 * 200 + flock.focal() * p.x() / -p.z() - 0.5, 150, 1e-9);
    EXPECT_NEAR(0.5 * 120 - flock.focal() * p.y() / -p.z() - 0.5, 30, 1e-9);
  }
  // A wingspan of 2 · (2 + 1.5 · 0.7) core scales in the picture.
  EXPECT_NEAR(flock.focal() / -near.z(), 4 * span_per_scale(bird_model().templates[0]), 1e-9);
}

TEST(BirdFlight, FliesForwardAndBanksIntoTurns) {
  BirdFlock flock(bird_model());
  BirdPose bird;
  for (int t = 0; t < 20; ++t) bird = flock.advance(one_bird(t, 40 + 3 * t, 60, 3, 0, 3, 0))[0];
  EXPECT_GT(bird.forward.x(), 0.999);
  EXPECT_GT(bird.up.y(), 0.999);
  for (int t = 20; t < 40; ++t)  // it comes nearer ever faster: a turn to the right, towards the camera
    bird = flock.advance(one_bird(t, 100 + 2 * (t - 20), 60, 3 * std::exp(0.002 * (t - 20) * (t - 20)), 0))[0];
  EXPECT_GT(bird.forward.z(), 0.05);
  EXPECT_GT(bird.up.dot(bird.forward.cross(Vector3(0, 1, 0)).normalized()), 0.01);  // leaning to its right
  EXPECT_NEAR(bird.forward.dot(bird.up), 0, 1e-9);
  EXPECT_NEAR(bird.up.norm(), 1, 1e-9);
}

TEST(BirdFlight, WingsFollowTheStates) {
  BirdFlock flock(bird_model());
  double highest = -1, lowest = 1, fastest = 0, before = 0;
  for (int t = 0; t < 48; ++t) {
    constexpr int kBeat[] = {1, 1, 1, 0, 2, 2, 2, 0};
    const double wing = flock.advance(one_bird(t, 50 + t, 60, 3, kBeat[t % 8], 1, 0))[0].wings.inner;
    if (t > 8) {
      highest = std::max(highest, wing);
      lowest = std::min(lowest, wing);
      fastest = std::max(fastest, std::abs(wing - before));
    }
    before = wing;
  }
  EXPECT_GT(highest, 0.6);
  EXPECT_LT(lowest, -0.6);
  EXPECT_LT(fastest, 0.75);  // of 1.57 between the outermost states
}

TEST(BirdFlight, StatesOfTheWingsDoNotMoveTheBird) {
  TexturedMotion model = bird_model();
  Cable cable;
  cable.species = 0;
  for (int t = 0; t < 60; ++t) {
    cable.poses.push_back(t % 2);
    cable.core.push_back(Base{BaseKind::kGaussian, 1.0 * t, 50, t % 2 == 1 ? 4.0 : 3.0, 0, {}});
  }
  model.cables = {cable};
  BirdFlock flock(model);
  double nearest = -HUGE_VAL, farthest = 0;
  for (int t = 0; t < 60; ++t) {
    const double z = flock.advance(one_bird(t, 1.0 * t, 50, t % 2 == 1 ? 4.0 : 3.0, t % 2, 1, 0))[0].position.z();
    nearest = std::max(nearest, z);
    farthest = std::min(farthest, z);
  }
  EXPECT_LT(farthest / nearest, 1.001);
}

TEST(BirdMesh, IsSymmetricAndOneWingspanWide) {
  const BirdMesh mesh = bird_mesh({});
  double right = 0, left = 0;
  for (const Vector3& v : mesh.vertices) {
    right = std::max(right, v.z());
    left = std::min(left, v.z());
  }
  EXPECT_NEAR(right, 0.5, 0.01);
  EXPECT_NEAR(left, -right, 1e-12);
  for (const std::array<int, 3>& face : mesh.triangles)
    for (const int corner : face) ASSERT_LT(corner, static_cast<int>(mesh.vertices.size()));
  double highest = 0;
  for (const Vector3& v : bird_mesh({0.8, 0, 0}).vertices) highest = std::max(highest, v.y());
  EXPECT_NEAR(highest, 0.465 * std::sin(0.8), 0.02);
}

TEST(BirdPainter, ABirdFromAheadIsAsWideAsItsSpan) {
  BirdPose bird;
  bird.position = {0, 0, -4};
  bird.forward = {0, 0, 1};
  const BirdSprite sprite = view_bird(bird, 200, 200, 120, {});
  EXPECT_NEAR(sprite.width, 200.0 / 4, 2);
  EXPECT_NEAR(sprite.left + 0.5 * sprite.width, 100, 1.5);
  const float cover = std::accumulate(sprite.alpha.begin(), sprite.alpha.end(), 0.F);
  EXPECT_GT(cover, 40);
  EXPECT_LT(cover, 250);
  bird.position = {0, 0, 4};  // behind the camera
  EXPECT_EQ(view_bird(bird, 200, 200, 120, {}).alpha.size(), 0U);
}

TEST(BirdPainter, PortraitShowsTheStateOfTheWings) {
  const auto highest = [](double inner) {
    const Image image = bird_portrait({inner, 0, 0}, 80);
    int y = 0;
    while (y < 80 && std::all_of(&image.at(0, y), &image.at(0, y) + 80, [](const Rgba& p) { return p.a < 128; })) ++y;
    return y;
  };
  EXPECT_GT(highest(-0.6), highest(0.7) + 8);
  EXPECT_GT(highest(0.7), 0);
}

TEST(BirdPainter, PictureIsTheLayerOverTheBackground) {
  const TexturedMotion model = bird_model();
  BirdPainter painter(model, {Plane(400, 240, 190)}, 2);
  Image picture, layer;
  painter.paint(one_bird(0, 100, 60, 4, 1, 3, 0), picture, layer);
  Image composed(400, 240, {190, 190, 190, 255});
  paste(composed, layer, 0, 0);
  int largest = 0, darkest = 255;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    largest = std::max(largest, std::abs(picture.pixels[i].r - composed.pixels[i].r));
    darkest = std::min<int>(darkest, picture.pixels[i].r);
  }
  EXPECT_LE(largest, 1);
  EXPECT_LT(darkest, 90);
  EXPECT_GT(layer.at(201, 121).a, 200);
  EXPECT_EQ(layer.at(5, 5).a, 0);
}

}  // namespace
}  // namespace motex
