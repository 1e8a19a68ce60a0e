// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/texton_edit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "motex/core/error.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/synthetic.h"
#include "motex/motion_texture/texton_stretch.h"

namespace motex {
namespace {

constexpr double kDegree = M_PI / 180;

const MotionTexture& walking_model() {
  static const MotionTexture model = [] {
    LearnOptions options;
    options.state_size = 6;
    LearnReport report;
    return learn_motion_texture(walking_clips(3, 400), options, report);
  }();
  return model;
}

int moving_joint(std::size_t k) { return walking_model().features.joints.at(k); }

PoseEdit turned(int joint, Index frame, const Vector3& rotation) {
  PoseEdit edit;
  edit.joint = joint, edit.frame = frame, edit.rotation = exp_map(rotation);
  return edit;
}

Clip edited(const std::vector<PoseEdit>& edits, EditReport& report, bool foot_fix = false, const JobContext& job = {}) {
  EditOptions options;
  options.foot_fix = foot_fix;
  return edit_texton(walking_model(), 1, edits, options, report, job);
}

double turn_between(const Clip& a, const Clip& b, Index frame, int joint) {
  return angle_between(a.rotation(frame, joint), b.rotation(frame, joint));
}

TEST(Edit, WrongInputIsRefused) {
  EditReport report;
  const int joint = moving_joint(0);
  const Index l = walking_model().instances[1].length;
  for (const Index frame : {Index{-1}, Index{1}, l - 2, l})
    EXPECT_THROW(edited({turned(joint, frame, Vector3::UnitX())}, report), InvalidInput) << frame;
  EXPECT_THROW(edited({turned(999, 20, Vector3::UnitX())}, report), InvalidInput);
  EXPECT_THROW(edited({turned(walking_model().features.travelling_joint, 20, Vector3::UnitX())}, report), InvalidInput);
  EXPECT_THROW(edited({turned(joint, 20, Vector3::UnitX()), turned(joint, 20, Vector3::UnitZ())}, report),
               InvalidInput);
  PoseEdit broken = turned(joint, 20, Vector3::UnitX());
  broken.rotation.w() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(edited({broken}, report), InvalidInput);
  broken.kind = EditKind::kSetHeight;
  broken.height = std::numeric_limits<double>::infinity();
  EXPECT_THROW(edited({broken}, report), InvalidInput);
  broken.kind = EditKind::kSetPose;
  EXPECT_THROW(edited({broken}, report), InvalidInput) << "no features";
  EXPECT_THROW(edit_texton(walking_model(), -1, {}, {}, report), InvalidInput);
}

TEST(Edit, ByNothingChangesNothing) {
  EditReport report;
  for (const bool foot_fix : {false, true}) {
    const Clip base = edited({}, report, foot_fix);
    PoseEdit height;
    height.kind = EditKind::kMoveHeight, height.frame = 30;
    const Clip same = edited({height}, report, foot_fix);
    EXPECT_EQ(same.rotations, base.rotations);
    EXPECT_EQ(same.translations, base.translations);
    const Clip turned_by_nothing = edited({turned(moving_joint(1), 30, Vector3::Zero())}, report, foot_fix);
    EXPECT_LT((turned_by_nothing.rotations - base.rotations).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(Edit, IsMetAndNothingElseMoves) {
  EditReport report;
  const Clip base = edited({}, report);
  const Index l = base.num_frames();
  for (std::size_t k = 0; k < walking_model().features.joints.size(); ++k) {
    for (const double degrees : {5.0, 40.0, 120.0}) {
      const int joint = moving_joint(k);
      const Vector3 turn = degrees * kDegree * Vector3(1, 2, -2) / 3;
      const Clip clip = edited({turned(joint, l / 3, turn)}, report);
      EXPECT_LT(angle_between(clip.rotation(l / 3, joint), exp_map(turn) * base.rotation(l / 3, joint)), 1e-6);
      for (Index t = 0; t < l; ++t)
        for (int j = 0; j < base.skeleton.num_joints(); ++j)
          if (j != joint || t < 2 || t > l - 3) {
            ASSERT_LT(turn_between(clip, base, t, j), 1e-6) << "frame " << t;
          }
      EXPECT_EQ(clip.translations, base.translations);
    }
  }
}

TEST(Edit, ComesAndGoesSmoothly) {
  EditReport report;
  const Clip base = edited({}, report);
  const Index frame = base.num_frames() / 2;
  const int joint = moving_joint(2);
  const Clip clip = edited({turned(joint, frame, 30 * kDegree * Vector3::UnitX())}, report);
  double before = 0, largest_step = 0;
  for (Index t = 0; t < base.num_frames(); ++t) {
    const double now = turn_between(clip, base, t, joint);
    largest_step = std::max(largest_step, std::abs(now - before));
    before = now;
  }
  EXPECT_LT(largest_step, 5 * kDegree) << "a bump, not a jump";
  EXPECT_GT(turn_between(clip, base, frame - 3, joint), 20 * kDegree);
}

TEST(Edit, SeveralAtOnce) {
  EditReport report;
  const Clip base = edited({}, report);
  const int a = moving_joint(1), b = moving_joint(3);
  PoseEdit height, tilt;
  height.kind = EditKind::kSetHeight, height.frame = 25, height.height = 0.9 * base.translation(25, 0).y();
  tilt.kind = EditKind::kMoveTilt, tilt.frame = 40, tilt.tilt_x = 0.2;
  PoseEdit set = turned(b, 35, Vector3(0.3, 0.1, 0));
  set.kind = EditKind::kSetJoint;
  const Clip clip = edited(
      {turned(a, 20, 0.5 * Vector3::UnitX()), turned(a, 38, -0.5 * Vector3::UnitX()), set, height, tilt}, report);
  EXPECT_LT(angle_between(clip.rotation(20, a), exp_map(0.5 * Vector3::UnitX()) * base.rotation(20, a)), 1e-6);
  EXPECT_LT(angle_between(clip.rotation(38, a), exp_map(-0.5 * Vector3::UnitX()) * base.rotation(38, a)), 1e-6);
  EXPECT_LT(angle_between(clip.rotation(35, b), exp_map(Vector3(0.3, 0.1, 0))), 1e-6);
  EXPECT_NEAR(clip.translation(25, 0).y(), height.height, 1e-9);
  EXPECT_NEAR(turn_between(clip, base, 40, walking_model().features.travelling_joint), 0.2, 0.05);
  ASSERT_EQ(report.parts.size(), 4U);
}

TEST(Edit, ALoweredBodyStandsOnItsFeet) {
  const MotionTexture& model = walking_model();
  ASSERT_FALSE(model.feet.legs.empty());
  EditReport report;
  const Clip base = edited({}, report, true);
  PoseEdit edit;
  edit.kind = EditKind::kMoveHeight, edit.frame = base.num_frames() / 2, edit.height = -6 / model.features.cm_per_unit;
  const Clip clip = edited({edit}, report, true), floating = edited({edit}, report, false);
  const int root = model.features.travelling_joint;
  EXPECT_NEAR(clip.translation(edit.frame, root).y(), floating.translation(edit.frame, root).y(), 1e-9);
  Pose before, held, loose;
  forward_kinematics(edited({}, report, false), edit.frame, before);
  forward_kinematics(clip, edit.frame, held);
  forward_kinematics(floating, edit.frame, loose);
  for (const Leg& leg : model.feet.legs) {
    EXPECT_GT((before.positions.col(leg.ankle_idx) - loose.positions.col(leg.ankle_idx)).norm(), 5);
    EXPECT_LT((before.positions.col(leg.ankle_idx) - held.positions.col(leg.ankle_idx)).norm(), 1);
  }
}

TEST(Edit, AWholePoseIsTaken) {
  const MotionTexture& model = walking_model();
  EditReport report;
  PoseEdit edit;
  edit.kind = EditKind::kSetPose, edit.frame = 30;
  const Instance& other = model.instances.back();
  edit.pose = model.corpus.row(other.row + 7).transpose().cast<double>();
  const Clip clip = edited({edit}, report), wanted = example_clip(model, static_cast<int>(model.instances.size()) - 1);
  for (int j = 0; j < clip.skeleton.num_joints(); ++j)
    if (j != model.features.travelling_joint) {
      EXPECT_LT(angle_between(clip.rotation(30, j), wanted.rotation(7, j)), 1e-5);
    }
  EXPECT_NEAR(clip.translation(30, 0).y(), wanted.translation(7, 0).y(), 1e-4);
}

TEST(Edit, LargeOnesAreMetWithAWarning) {
  std::vector<std::string> said;
  JobContext job;
  job.on_warning = [&](const std::string& text) { said.push_back(text); };
  EditReport report;
  const int joint = moving_joint(2);
  edited({turned(joint, 30, 0.01 * Vector3::UnitX())}, report, false, job);
  EXPECT_TRUE(said.empty());
  const double small = report.parts.at(0).strain;
  const Clip base = edited({}, report);
  const Clip clip = edited({turned(joint, 30, 2.5 * Vector3::UnitX())}, report, false, job);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said[0].find(clip.skeleton.joints[static_cast<std::size_t>(joint)].name), std::string::npos);
  EXPECT_NEAR(report.parts.at(0).strain / small, 250, 60);
  EXPECT_LT(angle_between(clip.rotation(30, joint), exp_map(2.5 * Vector3::UnitX()) * base.rotation(30, joint)), 1e-6);
}

}  // namespace
}  // namespace motex
