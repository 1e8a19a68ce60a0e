// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/limb_target.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/motion/stick_figure.h"

namespace motex {
namespace {

class LimbTargetTest : public testing::Test {
 protected:
  Vector3 place(const Clip& clip, const std::string& joint, Index frame) const {
    Pose pose;
    forward_kinematics(clip, frame, pose);
    return pose.positions.col(clip.skeleton.find(joint));
  }
  std::vector<std::string> warnings_;
  JobContext job() {
    JobContext job;
    job.on_warning = [this](const std::string& message) { warnings_.push_back(message); };
    return job;
  }
  StickFigure figure_ = walk_stick_figure({.num_frames = 200, .turn_rate = 0.3});
};

TEST_F(LimbTargetTest, WrongRequestsAreRefused) {
  Clip clip = figure_.clip;
  const auto reach = [&](const LimbTarget& target, std::vector<Index> pinned = {}) {
    return reach_targets(clip, {&target, 1}, {}, pinned);
  };
  EXPECT_THROW(reach({"Hand", 10, {}}), InvalidInput);
  EXPECT_THROW(reach({"LeftHand", 200, {}}), InvalidInput);
  EXPECT_THROW(reach({"LeftHand", -1, {}}), InvalidInput);
  EXPECT_THROW(reach({"LeftHand", 10, {0, HUGE_VAL, 0}}), InvalidInput);
  EXPECT_THROW(reach({"LeftHand", 10, {}}, {10}), InvalidInput);
  EXPECT_THROW(reach({"Hips", 10, {}}), InvalidInput);
  const std::vector<LimbTarget> twice(2, LimbTarget{"LeftHand", 10, {}});
  EXPECT_THROW(reach_targets(clip, twice), InvalidInput);
  EXPECT_EQ(clip.rotations, figure_.clip.rotations);
}

TEST_F(LimbTargetTest, HandsAndFeetAreThere) {
  for (const auto& [joint, way] : {std::pair<std::string, Vector3>{"LeftHand", {15, 20, 25}},
                                   {"RightHand", {-10, 35, 10}},
                                   {"LeftFoot", {8, 12, 10}},
                                   {"RightFoot", {-5, 20, -10}},
                                   {"LeftForeArm", {5, 10, 10}}}) {
    Clip clip = figure_.clip;
    const LimbTarget target{joint, 90, place(clip, joint, 90) + way};
    const auto reached = reach_targets(clip, {&target, 1}, {}, {}, job());
    EXPECT_LT((place(clip, joint, 90) - target.position).norm(), 0.05) << joint;
    EXPECT_NEAR(reached[0].distance_before, way.norm(), 1e-9);
    EXPECT_NEAR(reached[0].distance_after, (place(clip, joint, 90) - target.position).norm(), 1e-9);
    EXPECT_EQ(clip.translations, figure_.clip.translations);
    for (const Index t : {0, 60, 120, 199}) EXPECT_EQ(clip.rotations.row(t), figure_.clip.rotations.row(t)) << t;
  }
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(LimbTargetTest, ComesAndGoesSmoothly) {
  Clip clip = figure_.clip;
  const LimbTarget target{"LeftHand", 90, place(clip, "LeftHand", 90) + Vector3(10, 20, 20)};
  reach_targets(clip, {&target, 1});
  double largest = 0;
  for (Index t = 1; t + 1 < 200; ++t)
    largest = std::max(
        largest,
        (place(clip, "LeftHand", t + 1) - 2 * place(clip, "LeftHand", t) + place(clip, "LeftHand", t - 1)).norm());
  EXPECT_LT(largest, 0.5) << "30 cm there and back in half a second each, cm/frame²";
}

TEST_F(LimbTargetTest, TheOtherLimbsStay) {
  Clip clip = figure_.clip;
  const LimbTarget target{"LeftHand", 90, place(clip, "LeftHand", 90) + Vector3(10, 20, 20)};
  const auto reached = reach_targets(clip, {&target, 1});
  for (const char* joint : {"RightHand", "Head", "LeftFoot", "RightFoot", "LeftArm"})
    EXPECT_LT((place(clip, joint, 90) - place(figure_.clip, joint, 90)).norm(), 1e-9) << joint;
  EXPECT_EQ(reached[0].joints.size(), 2U);
}

TEST_F(LimbTargetTest, WhatIsTooFarIsSaidAndTheBodyHelps) {
  Clip clip = figure_.clip;
  const Vector3 shoulder = place(clip, "RightArm", 90);
  const LimbTarget leaning{"RightHand", 90, shoulder + Vector3(0, -20, 60)};
  const auto reached = reach_targets(clip, {&leaning, 1}, {}, {}, job());
  EXPECT_LT(reached[0].distance_after, 0.2);
  EXPECT_EQ(reached[0].joints.size(), 3U) << "with the spine";
  EXPECT_TRUE(warnings_.empty());
  clip = figure_.clip;
  const LimbTarget beyond{"RightHand", 90, shoulder + Vector3(0, 0, 300)};
  const auto missed = reach_targets(clip, {&beyond, 1}, {}, {}, job());
  EXPECT_GT(missed[0].distance_after, 150);
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_NE(warnings_[0].find("RightHand cannot be there at frame 90"), std::string::npos) << warnings_[0];
  check_clip(clip);
}

TEST_F(LimbTargetTest, SeveralAreMetTogetherAndPinnedFramesStay) {
  Clip clip = figure_.clip;
  std::vector<LimbTarget> targets;
  for (const auto& [joint, frame] : {std::pair<std::string, Index>{"LeftHand", 80},
                                     {"LeftHand", 96},
                                     {"RightHand", 80},
                                     {"LeftForeArm", 60},
                                     {"RightFoot", 88}})
    targets.push_back({joint, frame, place(clip, joint, frame) + Vector3(6, 12, 8)});
  const std::vector<Index> pinned{70, 104};
  for (const ReachedTarget& reached : reach_targets(clip, targets, {}, pinned, job()))
    EXPECT_LT(reached.distance_after, 0.2);
  for (const Index t : pinned) EXPECT_EQ(clip.rotations.row(t), figure_.clip.rotations.row(t));
}

}  // namespace
}  // namespace motex
