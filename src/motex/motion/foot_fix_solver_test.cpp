// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/foot_fix_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "motex/core/rng.h"
#include "motex/motion/stick_figure.h"

namespace motex {
namespace {

TEST(CorrectionSolver, MinimisesItsObjective) {
  Rng rng(1);
  for (const Index n : {1, 2, 3, 17}) {
    CorrectionSolver solver;
    solver.resize(n);
    const double bend = 20;
    const Eigen::Vector2d last(0.3, -0.2), before_last(0.1, 0.4);
    // The same objective as a dense least-squares problem: rows of A d = y.
    Matrix a = Matrix::Zero(3 * n, n), y = Matrix::Zero(3 * n, 2);
    for (Index s = 0; s < n; ++s) {
      auto& step = solver.step(s);
      step = {s % 3 == 0 ? 0 : rng.uniform(1, 100), {rng.normal(), rng.normal()}, false};
      const double hold = std::sqrt(step.hold), stiff = std::sqrt(bend);
      a(3 * s, s) = 1;
      a(3 * s + 1, s) = hold;
      y.row(3 * s + 1) = -hold * step.slide.transpose();
      if (s > 0) a(3 * s + 1, s - 1) = -hold;
      if (s == 0) y.row(1) += hold * last.transpose();
      a(3 * s + 2, s) = stiff;
      if (s > 0) a(3 * s + 2, s - 1) = -2 * stiff;
      if (s > 1) a(3 * s + 2, s - 2) = stiff;
      if (s == 0) y.row(2) += stiff * (2 * last - before_last).transpose();
      if (s == 1) y.row(5) -= stiff * last.transpose();
    }
    const Matrix truth = (a.transpose() * a).ldlt().solve(a.transpose() * y);
    EXPECT_LT((solver.solve(n, bend, last, before_last).transpose() - truth.row(0)).norm(), 1e-10) << n;
  }
}

class SolveLegTest : public testing::Test {
 protected:
  void SetUp() override {
    clip_ = walk_stick_figure().clip;
    leg_ = learn_foot_model({&clip_, 1}).legs[0];
    forward_kinematics(clip_, 10, pose_);
  }
  /// Where the solved leg puts the ankle.
  Vector3 ankle(const LegSolution& solved, const Vector3& hip_shift) const {
    return Vector3(pose_.positions.col(leg_.hip_idx)) + hip_shift +
           solved.thigh * clip_.translation(10, leg_.knee_idx) + solved.shank * clip_.translation(10, leg_.ankle_idx);
  }
  Clip clip_;
  Leg leg_;
  Pose pose_;
};

TEST_F(SolveLegTest, ReachesWhatIsInReach) {
  const Vector3 hip_shift(0.5, -3, 0.2), ankle_shift(3, 1, -2);
  const LegSolution solved = solve_leg(pose_, leg_, hip_shift, ankle_shift);
  EXPECT_NEAR(solved.missing, 0, 1e-3);
  EXPECT_LT((ankle(solved, hip_shift) - pose_.positions.col(leg_.ankle_idx) - ankle_shift).norm(), 1e-3);
  EXPECT_GT(solved.steepness, 0.8);
}

TEST_F(SolveLegTest, NoShiftIsNoChange) {
  const LegSolution solved = solve_leg(pose_, leg_, Vector3::Zero(), Vector3::Zero());
  EXPECT_LT(angle_between(solved.thigh, pose_.rotation(leg_.hip_idx)), 1e-9);
  EXPECT_LT(angle_between(solved.shank, pose_.rotation(leg_.knee_idx)), 1e-7);
}

TEST_F(SolveLegTest, StretchesSoftlyTowardsFarTargets) {
  const Vector3 down = (pose_.positions.col(leg_.ankle_idx) - pose_.positions.col(leg_.hip_idx)).normalized();
  double reach = 0;
  for (int cm = 0; cm < 100; ++cm) {
    const LegSolution solved = solve_leg(pose_, leg_, Vector3::Zero(), cm * down);
    const double now = (ankle(solved, Vector3::Zero()) - pose_.positions.col(leg_.hip_idx)).norm();
    EXPECT_GE(now, reach - 1e-9);
    EXPECT_LT(now, 84);
    EXPECT_NEAR(solved.missing,
                (pose_.positions.col(leg_.ankle_idx) - pose_.positions.col(leg_.hip_idx)).norm() + cm - now, 1e-6);
    reach = now;
  }
  EXPECT_GT(reach, 83);
}

TEST_F(SolveLegTest, StraightLegBendsForwards) {
  for (const int j : {leg_.knee_idx, leg_.ankle_idx}) clip_.set_rotation(10, j, Quat::Identity());
  forward_kinematics(clip_, 10, pose_);
  // An exactly straight leg: only the learned axis tells which way the knee goes.
  const LegSolution solved = solve_leg(pose_, leg_, Vector3(0, -6, 0), Vector3::Zero());
  EXPECT_TRUE(solved.thigh.coeffs().allFinite());
  const Vector3 knee = solved.thigh * clip_.translation(10, leg_.knee_idx);
  const Vector3 straight = pose_.rotation(leg_.hip_idx) * clip_.translation(10, leg_.knee_idx);
  EXPECT_GT((knee - straight).dot(pose_.rotation(0) * Vector3::UnitZ()), 0);
}

}  // namespace
}  // namespace motex
