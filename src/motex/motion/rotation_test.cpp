// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/rotation.h"

#include <gtest/gtest.h>

#include <numbers>

#include "motex/core/rng.h"

namespace motex {
namespace {

Quat random_quat(Rng& rng) { return Quat(rng.normal(), rng.normal(), rng.normal(), rng.normal()).normalized(); }

TEST(Rotation, LogInvertsExp) {
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 v = Vector3(rng.normal(), rng.normal(), rng.normal()) * (i % 3 == 0 ? 1e-7 : 0.9);
    if (v.norm() > 3.1) continue;
    EXPECT_LT((log_map(exp_map(v)) - v).norm(), 1e-12 + 1e-12 * v.norm());
  }
  EXPECT_EQ(log_map(Quat::Identity()).norm(), 0);
}

TEST(Rotation, LogNearFollowsContinuity) {
  const Vector3 axis = Vector3(1, 2, -1).normalized();
  Vector3 near = Vector3::Zero();
  for (int i = 0; i < 400; ++i) {
    const double angle = 0.05 * i;
    near = log_map_near(exp_map(axis * angle), near);
    EXPECT_LT((near - axis * angle).norm(), 1e-9) << i;
  }
}

TEST(Rotation, EulerInvertsForAllTwelveOrders) {
  Rng rng(2);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) {
        if (i == j || j == k) continue;
        const EulerOrder order{{i, j, k}};
        for (int n = 0; n < 200; ++n) {
          const Quat q = random_quat(rng);
          const Vector3 near(rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(-9, 9));
          EXPECT_LT(angle_between(quat_from_euler(order, euler_from_quat(order, q, near)), q), 1e-7);
        }
        for (const double lock : {-0.5, 0.0, 0.5, 1.0}) {
          const Quat q = quat_from_euler(order, Vector3(0.3, lock * std::numbers::pi, -0.8));
          EXPECT_LT(angle_between(quat_from_euler(order, euler_from_quat(order, q)), q), 1e-6);
        }
      }
}

TEST(Rotation, EulerStaysNear) {
  const EulerOrder order{{2, 0, 1}};
  const Vector3 angles(7.0, 2.5, -4.0);  // second angle beyond the principal range
  const Vector3 found = euler_from_quat(order, quat_from_euler(order, angles), angles + Vector3(0.1, -0.1, 0.05));
  EXPECT_LT((found - angles).norm(), 1e-9);
}

TEST(Rotation, MeanIgnoresSigns) {
  Rng rng(3);
  const Quat centre = random_quat(rng);
  FrameMatrix quats(500, 4);
  for (int i = 0; i < 500; ++i) {
    const Quat q = centre * exp_map(0.2 * Vector3(rng.normal(), rng.normal(), rng.normal()));
    const double sign = i % 2 == 0 ? 1 : -1;
    quats.row(i) << sign * q.w(), sign * q.x(), sign * q.y(), sign * q.z();
  }
  EXPECT_LT(angle_between(mean_rotation(quats), centre), 0.05);
}

}  // namespace
}  // namespace motex
