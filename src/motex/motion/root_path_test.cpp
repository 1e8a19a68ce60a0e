// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/root_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr double kPi = std::numbers::pi;

/// A walk that sways along +z at 1.2 m/s, 60 frames a second, in cm; it stands still in the last quarter.
RootPath walk(Index frames) {
  RootPath path{Vector(frames), Vector(frames), Vector(frames)};
  double z = 0;
  for (Index t = 0; t < frames; ++t) {
    const auto secs = static_cast<double>(t) / 60;
    if (4 * t < 3 * frames) z += 2;
    path.x[t] = 3 * std::sin(2 * kPi * secs);
    path.z[t] = z;
    path.heading[t] = 0.1 * std::sin(2 * kPi * secs);
  }
  return path;
}

double step(const RootPath& path, Index t) { return std::hypot(path.x[t] - path.x[t - 1], path.z[t] - path.z[t - 1]); }

BendPathReport bend(RootPath& path, const std::vector<RootTarget>& targets, const std::vector<FloorBox>& boxes = {}) {
  return bend_root_path(path, 1.0 / 60, 1, targets, boxes, {});
}

TEST(BendRootPath, WrongRequestsAreRefused) {
  RootPath path = walk(300);
  EXPECT_THROW(bend(path, {{300, 0, 0, {}}}), InvalidInput);
  EXPECT_THROW(bend(path, {{0, 0, 0, {}}}), InvalidInput);
  EXPECT_THROW(bend(path, {{9, 0, 0, {}}, {9, 1, 0, {}}}), InvalidInput);
  EXPECT_THROW(bend(path, {}, {{-5, -5, 5, 5}}), InvalidInput) << "starts inside";
  EXPECT_THROW(bend(path, {{299, 200, 200, {}}}, {{190, 190, 250, 250}}), InvalidInput) << "target inside";
  RootPath cage = walk(300);
  EXPECT_THROW(bend(cage, {{299, 0, 400, {}}}, {{-1e4, 200, 1e4, 240}}), InvalidInput) << "a wall without an end";
  BendPathOptions options;
  options.body_radius = -1;
  EXPECT_THROW(bend_root_path(path, 1.0 / 60, 1, {}, {}, {}, options), InvalidInput);
  EXPECT_EQ(path.x, walk(300).x);
}

TEST(BendRootPath, MeetsPlacesAndHeadings) {
  for (const auto& [x, z, heading] : {std::tuple{100.0, 300.0, 0.5}, {-250.0, 200.0, -1.5}, {30.0, -200.0, 3.0}}) {
    RootPath path = walk(400);
    const BendPathReport report = bend(path, {{200, x / 3, z / 3 + 60, {}}, {399, x, z, heading}});
    EXPECT_NEAR(path.x[200], x / 3, 1e-6);
    EXPECT_NEAR(path.z[200], z / 3 + 60, 1e-6);
    EXPECT_NEAR(path.x[399], x, 1e-6);
    EXPECT_NEAR(path.z[399], z, 1e-6);
    EXPECT_NEAR(std::remainder(path.heading[399] - heading, 2 * kPi), 0, 1e-9);
    EXPECT_GT(report.cost, 0);
    EXPECT_EQ(path.x[0], walk(400).x[0]);
  }
}

TEST(BendRootPath, WhereThePathGoesByItselfNothingChanges) {
  const RootPath source = walk(300);
  RootPath path = source;
  bend(path, {{150, source.x[150], source.z[150], source.heading[150]}});
  EXPECT_LT((path.x - source.x).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((path.heading - source.heading).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(BendRootPath, IsSmoothAndLetsStandingFeetStand) {
  const RootPath source = walk(400);
  RootPath path = source;
  bend(path, {{399, 150, source.z[399] - 60, 0.8}});
  for (Index t = 1; t < 400; ++t) EXPECT_NEAR(step(path, t), step(source, t), 0.6 * step(source, t) + 0.02) << t;
  for (Index t = 2; t < 400; ++t) {
    EXPECT_LT(std::abs(path.heading[t] - 2 * path.heading[t - 1] + path.heading[t - 2]), 0.005) << t;
    EXPECT_LT(std::abs(step(path, t) - step(path, t - 1)), std::abs(step(source, t) - step(source, t - 1)) + 0.1) << t;
  }
  EXPECT_LT(std::abs(path.heading[399] - path.heading[330]), 0.4 * 0.8);
  EXPECT_NEAR(path.x[1] - path.x[0], source.x[1] - source.x[0], 1e-3);
  EXPECT_NEAR(path.heading[399] - path.heading[398], source.heading[399] - source.heading[398], 1e-3);
}

TEST(BendRootPath, KeepsClearOfBoxes) {
  const std::vector<FloorBox> boxes{{-20, 150, 60, 220}, {-150, 330, -40, 400}};
  for (const bool has_target : {false, true}) {
    RootPath path = walk(500);
    std::vector<RootTarget> targets;
    if (has_target) targets.push_back({499, 20, 700, 0.0});
    const BendPathReport report = bend(path, targets, boxes);
    Index frame = 0;
    EXPECT_GE(clearance(path, boxes, frame), 30) << "frame " << frame;
    EXPECT_DOUBLE_EQ(report.clearance, clearance(path, boxes, frame));
    if (has_target) {
      EXPECT_NEAR(path.x[499], 20, 1e-6);
    }
    for (Index t = 1; t < 500; ++t) EXPECT_LT(step(path, t), 4) << t;
  }
}

TEST(BendRootPath, AWayThatIsClearStaysAsItIs) {
  const RootPath source = walk(300);
  RootPath path = source;
  const BendPathReport report = bend(path, {}, {{100, 100, 200, 200}});
  EXPECT_EQ(path.x, source.x);
  EXPECT_EQ(report.cost, 0);
  EXPECT_NEAR(report.clearance, 97, 1);
}

TEST(BendRootPath, UnitsDoNotMatter) {
  RootPath cm = walk(300), inches = walk(300);
  inches.x /= 2.54, inches.z /= 2.54;
  bend(cm, {{299, 100, 200, 1.0}});
  const RootTarget target{299, 100 / 2.54, 200 / 2.54, 1.0};
  bend_root_path(inches, 1.0 / 60, 2.54, {&target, 1});
  EXPECT_LT((2.54 * inches.x - cm.x).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((inches.heading - cm.heading).cwiseAbs().maxCoeff(), 1e-8);
}

}  // namespace
}  // namespace motex
