// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/retarget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/motion/stick_figure.h"

namespace motex {
namespace {

Clip walk() {
  StickFigureOptions options;
  options.num_frames = 240;
  options.turn_rate = 0.3;
  options.noise = 0.2;
  return walk_stick_figure(options).clip;
}

/// The same bones in another posture and scale: every joint's frame is turned, so that a body at rest looks otherwise.
Skeleton bent(const Skeleton& skeleton, double scale) {
  Skeleton out = skeleton;
  for (Joint& joint : out.joints) {
    joint.offset *= scale;
    const bool arm = joint.name.find("ForeArm") != std::string::npos || joint.name.find("Hand") != std::string::npos;
    if (arm) joint.offset = exp_map(Vector3(0, 0, joint.name.starts_with("Left") ? -0.7 : 0.7)) * joint.offset;
    joint.name = "rig:" + joint.name;
  }
  for (EndSite& site : out.end_sites) site.offset *= scale;
  return out;
}

Clip go(const Clip& source, const Skeleton& target, RetargetReport& report, bool foot_fix = false) {
  RetargetOptions options;
  options.foot_fix = foot_fix;
  const PosedSkeleton body = at_rest(target);
  return retarget(source, at_rest(source.skeleton).pose, body, match_joints(source.skeleton, target), options, report);
}

TEST(Retarget, ToTheSameBodyChangesNothing) {
  const Clip source = walk();
  RetargetReport report;
  const Clip out = go(source, source.skeleton, report);
  EXPECT_LT((world_positions(out) - world_positions(source)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_NEAR(report.scale, 1, 1e-12);
  EXPECT_NEAR(report.height_shift, 0, 1e-9);
  EXPECT_TRUE(report.unmatched.empty());
}

TEST(Retarget, DirectionsAreKeptWhateverTheRestPose) {
  const Clip source = walk();
  RetargetReport report;
  const Clip out = go(source, bent(source.skeleton, 2.5), report);
  EXPECT_NEAR(report.scale, 2.5, 1e-9);
  EXPECT_EQ(report.num_limbs, 8);
  EXPECT_LT(report.max_direction_error, 1e-6);
  // Colinear bones of one scale: all joints stand where the source's do, times 2.5.
  const Index n = 3 * source.skeleton.num_joints();
  EXPECT_LT((world_positions(out).leftCols(n) - 2.5 * world_positions(source).leftCols(n)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Retarget, ASkinTellsHowTheJointsFramesLie) {
  const Clip source = walk();
  Skeleton target = source.skeleton;
  auto skin = std::make_shared<Skin>();
  std::vector<Quat> turns;
  for (Joint& joint : target.joints) {
    const auto k = static_cast<double>(turns.size());
    turns.push_back(exp_map(Vector3(std::sin(3 * k), std::cos(5 * k), std::sin(7 * k + 1))));
    if (joint.parent_idx >= 0)
      joint.offset = turns[static_cast<std::size_t>(joint.parent_idx)].conjugate() * joint.offset;
    skin->joints.push_back({joint.name, Vector3::Zero(), turns.back()});
  }
  for (EndSite& site : target.end_sites)
    site.offset = turns[static_cast<std::size_t>(site.parent_idx)].conjugate() * site.offset;
  target.skin = skin;
  RetargetOptions options;
  options.foot_fix = false;
  RetargetReport report;
  const Clip out = retarget(source, as_bound(source.skeleton).pose, as_bound(target),
                            match_joints(source.skeleton, target), options, report);
  EXPECT_LT((world_positions(out) - world_positions(source)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Retarget, ABodyThatLooksTheOtherWay) {
  const Clip source = walk();
  Skeleton turned = source.skeleton;
  const Quat about(Eigen::AngleAxisd(2.8, Vector3::UnitY()));
  for (Joint& joint : turned.joints) joint.offset = about * joint.offset;
  for (EndSite& site : turned.end_sites) site.offset = about * site.offset;
  RetargetReport report;
  const Clip out = go(source, turned, report);
  EXPECT_LT((world_positions(out) - world_positions(source)).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Retarget, ShorterLegsStandOnTheFloorAndDoNotSlide) {
  const Clip source = walk();
  Skeleton target = source.skeleton;
  for (Joint& joint : target.joints) {
    if (joint.name.ends_with("Foot")) joint.offset *= 0.8;
    if (joint.name.ends_with("ToeBase")) joint.offset = Vector3(joint.offset.x(), -3, 14);
  }
  RetargetReport report;
  const Clip held = go(source, target, report, true);
  EXPECT_LT(report.max_direction_error, 1e-6);
  EXPECT_GT(report.contact_speed_before, 4);
  EXPECT_LT(report.contact_speed_after, 0.25 * report.contact_speed_before);
  const FrameMatrix positions = world_positions(held), before = world_positions(source);
  double low = 1e9, low_before = 1e9;
  for (Index c = 1; c < positions.cols(); c += 3) {
    low = std::min(low, positions.col(c).minCoeff());
    low_before = std::min(low_before, before.col(c).minCoeff());
  }
  EXPECT_NEAR(low, low_before * report.scale, 1.5);
}

TEST(Retarget, JointsWithoutSourceKeepTheirAnglesAndAreListed) {
  const Clip source = walk();
  Skeleton target = source.skeleton;
  const int spine = target.find("Spine");
  ASSERT_GE(spine, 0);
  target.joints.push_back({"Tail", 0, Vector3(0, 0, -10), {}});
  RetargetReport report;
  const Clip out = go(source, target, report);
  ASSERT_EQ(report.unmatched, std::vector<std::string>{"Tail"});
  const int tail = target.find("Tail");
  for (Index t = 0; t < out.num_frames(); t += 50)
    EXPECT_NEAR(angle_between(out.rotation(t, tail), Quat::Identity()), 0, 1e-9);
}

TEST(Retarget, BonesBetweenThatBend) {
  // The source has a joint in the middle of its spine that the target lacks.
  Clip source = walk();
  Skeleton& skeleton = source.skeleton;
  const int spine = skeleton.find("Spine"), head = skeleton.find("Head");
  ASSERT_EQ(skeleton.joints[static_cast<std::size_t>(head)].parent_idx, spine);
  for (Index t = 0; t < source.num_frames(); ++t)
    source.set_translation(t, head,
                           source.translation(t, head) + Vector3(3 * std::sin(0.1 * static_cast<double>(t)), 0, 0));
  RetargetReport report;
  go(source, walk().skeleton, report);
  EXPECT_LT(report.max_direction_error, 1e-6);
}

TEST(Retarget, BadRequests) {
  const Clip source = walk();
  RetargetReport report;
  JointMap map;
  map.source_of.assign(source.skeleton.joints.size(), -1);
  const PosedSkeleton body = at_rest(source.skeleton);
  EXPECT_THROW(retarget(source, body.pose, body, map, {}, report), InvalidInput);
  map.source_of.assign(3, 0);
  EXPECT_THROW(retarget(source, body.pose, body, map, {}, report), InvalidInput);
  EXPECT_THROW(at_frame(source, 240), InvalidInput);
}

}  // namespace
}  // namespace motex
