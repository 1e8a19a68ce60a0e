// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/adapt_clip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/motion/stick_figure.h"
#include "motex/motion/up_axis.h"

namespace motex {
namespace {

constexpr double kExact = 1e-9;

/// Every joint turns in its own way; the root travels, turns more than a whole turn and rises.
Clip dancer() {
  Skeleton skeleton;
  const auto add = [&](const std::string& name, int parent, const Vector3& offset) {
    Joint joint;
    joint.name = name;
    joint.parent_idx = parent;
    joint.offset = offset;
    joint.channels = {Channel::kZRotation, Channel::kXRotation, Channel::kYRotation};
    skeleton.joints.push_back(joint);
    return skeleton.num_joints() - 1;
  };
  const int hips = add("Hips", -1, {0, 0, 0});
  const int spine = add("Spine", hips, {0, 20, 0.5});
  const int chest = add("Chest", spine, {0, 25, -0.5});
  const int arm = add("LeftArm", chest, {18, 20, 0});
  const int hand = add("LeftHand", arm, {50, 0, 0});
  add("LeftFinger1", hand, {8, 0, 2});
  add("LeftFinger2", hand, {8, 0, -2});
  const int leg = add("LeftLeg", hips, {10, -5, 0});
  skeleton.end_sites = {{leg, {0, -80, 5}}, {5, {3, 0, 0}}};
  Clip clip = make_clip(skeleton, 60, 1.0 / 60);
  clip.name = "dancer";
  for (Index t = 0; t < 60; ++t) {
    const double time = static_cast<double>(t) / 10;
    clip.set_translation(t, 0, Vector3(30 * time, 90 + 5 * std::sin(time), -12 * time * time));
    clip.set_rotation(t, 0, Quat(Eigen::AngleAxisd(1.5 * time, Vector3::UnitY())) * exp_map(Vector3(0.2, 0, 0.1)));
    for (int j = 1; j < clip.skeleton.num_joints(); ++j)
      clip.set_rotation(t, j, exp_map(Vector3(std::sin(time + j), std::cos(2 * time - j), std::sin(j * time))));
  }
  return clip;
}

/// Largest distance of a joint of `b` from the joint of that name in `a`, after the map.
template <typename Map>
double largest_distance(const Clip& a, const Clip& b, Map map) {
  Pose in_a, in_b;
  double largest = 0;
  for (Index t = 0; t < b.num_frames(); ++t) {
    forward_kinematics(a, t, in_a);
    forward_kinematics(b, t, in_b);
    for (int j = 0; j < b.skeleton.num_joints(); ++j) {
      const int i = a.skeleton.find(b.skeleton.joints[static_cast<std::size_t>(j)].name);
      if (i < 0) continue;
      largest = std::max(largest, (Vector3(in_b.positions.col(j)) - map(Vector3(in_a.positions.col(i)), t)).norm());
    }
  }
  return largest;
}
double largest_distance(const Clip& a, const Clip& b) {
  return largest_distance(a, b, [](const Vector3& p, Index) { return p; });
}

double largest_turn(const Clip& a, const Clip& b) {
  Pose in_a, in_b;
  double largest = 0;
  for (Index t = 0; t < b.num_frames(); ++t) {
    forward_kinematics(a, t, in_a);
    forward_kinematics(b, t, in_b);
    for (int j = 0; j < b.skeleton.num_joints(); ++j) {
      const int i = a.skeleton.find(b.skeleton.joints[static_cast<std::size_t>(j)].name);
      if (i >= 0) largest = std::max(largest, angle_between(in_a.rotation(i), in_b.rotation(j)));
    }
  }
  return largest;
}

AdaptClipOptions with(const std::string& joints, const std::string& without) {
  AdaptClipOptions options;
  options.joints = joints;
  options.without = without;
  return options;
}

TEST(AdaptClip, RefusesJointsThatDoNotExist) {
  EXPECT_THROW(adapt_clip(dancer(), with("Hips,Tail", "")), InvalidInput);
  EXPECT_THROW(adapt_clip(dancer(), with("", "Tail*")), InvalidInput);
  EXPECT_THROW(adapt_clip(dancer(), with("", "*")), InvalidInput);
}

TEST(AdaptClip, DefaultsChangeNothing) {
  const Clip clip = dancer(), same = adapt_clip(clip, {});
  EXPECT_EQ(same.translations, clip.translations);
  EXPECT_EQ(same.rotations, clip.rotations);
  EXPECT_EQ(same.frame_time_secs, clip.frame_time_secs);
}

TEST(AdaptClip, KeptJointsStayWhereTheyAre) {
  const Clip clip = dancer();
  const Clip inner = adapt_clip(clip, with("", "Spine,LeftArm"));
  ASSERT_EQ(inner.skeleton.num_joints(), 6);
  EXPECT_EQ(inner.skeleton.joints[1].name, "Chest");
  EXPECT_EQ(inner.skeleton.joints[1].parent_idx, 0);
  EXPECT_LT(largest_distance(clip, inner), kExact);
  EXPECT_LT(largest_turn(clip, inner), 1e-7);
  const Clip floating = adapt_clip(clip, with("LeftHand,LeftLeg", ""));
  ASSERT_EQ(floating.skeleton.num_joints(), 2);
  EXPECT_EQ(floating.skeleton.joints[0].parent_idx, -1);
  EXPECT_EQ(floating.skeleton.joints[1].parent_idx, -1);
  EXPECT_LT(largest_distance(clip, floating), kExact);
  EXPECT_NO_THROW(check_clip(floating));
}

TEST(AdaptClip, LimbsThatAreCutShortKeepTheirTips) {
  const Clip cut = adapt_clip(dancer(), with("", "*Finger*"));
  ASSERT_EQ(cut.skeleton.num_joints(), 6);
  ASSERT_EQ(cut.skeleton.end_sites.size(), 3U);  // the foot, and where the fingers began
  EXPECT_EQ(cut.skeleton.end_sites[1].parent_idx, cut.skeleton.find("LeftHand"));
  EXPECT_EQ(cut.skeleton.end_sites[1].offset, Vector3(8, 0, 2));
  EXPECT_EQ(cut.skeleton.end_sites[2].offset, Vector3(8, 0, -2));
}

TEST(AdaptClip, InPlaceTakesTheTravelAwayAndNothingElse) {
  const Clip clip = dancer();
  AdaptClipOptions options;
  options.root = RootMotion::kInPlace;
  const Clip held = adapt_clip(clip, options);
  const auto without_travel = [&](const Vector3& p, Index t) {
    const Vector3 root = clip.translation(t, 0);
    return Vector3(p.x() - root.x(), p.y(), p.z() - root.z());
  };
  EXPECT_LT(largest_distance(clip, held, without_travel), kExact);
  EXPECT_EQ(held.rotations, clip.rotations);
}

TEST(AdaptClip, RootBoneCarriesTravelAndHeading) {
  const Clip clip = dancer();
  AdaptClipOptions options;
  options.root = RootMotion::kBone;
  options.joints = "Hips,LeftArm";
  const Clip moved = adapt_clip(clip, options);
  ASSERT_EQ(moved.skeleton.num_joints(), 3);
  EXPECT_EQ(moved.skeleton.joints[0].name, "root_motion");
  EXPECT_LT(largest_distance(clip, moved), kExact);
  EXPECT_LT(largest_turn(clip, moved), 1e-7);
  for (Index t = 0; t < moved.num_frames(); ++t) {
    EXPECT_EQ(moved.translation(t, 0).y(), 0);
    EXPECT_NEAR(moved.translation(t, 1).x(), 0, kExact);
    EXPECT_NEAR(moved.translation(t, 1).z(), 0, kExact);
    const Quat body = moved.rotation(t, 1);
    EXPECT_NEAR(body.y(), 0, 1e-12);  // what is left has no heading
  }
}

TEST(AdaptClip, ScaleAndUnitAreTheKnownMap) {
  Clip clip = dancer();
  clip.skeleton.metres_per_unit = 0.01;
  AdaptClipOptions options;
  options.scale = 1.25;
  options.out_unit = LengthUnit::kInch;
  const Clip out = adapt_clip(clip, options);
  const double factor = 1.25 * 0.01 / 0.0254;
  EXPECT_LT(largest_distance(clip, out, [&](const Vector3& p, Index) { return Vector3(p * factor); }), kExact);
  EXPECT_DOUBLE_EQ(out.skeleton.metres_per_unit, 0.0254);
  EXPECT_NEAR((out.skeleton.end_sites[0].offset - factor * clip.skeleton.end_sites[0].offset).norm(), 0, kExact);
}

TEST(AdaptClip, AnUnknownUnitIsGuessedAndSaid) {
  Clip clip = dancer();
  std::vector<std::string> warnings;
  JobContext job;
  job.on_warning = [&](const std::string& text) { warnings.push_back(text); };
  AdaptClipOptions options;
  options.scale = 2;
  const Clip out = adapt_clip(clip, options, job);
  EXPECT_DOUBLE_EQ(out.skeleton.metres_per_unit, metres_per_unit_or_guess(clip.skeleton));
  EXPECT_EQ(warnings.size(), 1U);
}

TEST(AdaptClip, ResamplesAtOutFps) {
  AdaptClipOptions options;
  options.out_fps = 30;
  const Clip out = adapt_clip(dancer(), options);
  EXPECT_EQ(out.num_frames(), 30);
  EXPECT_DOUBLE_EQ(out.frame_rate(), 30);
}

TEST(TurnUpAxis, WorldPositionsTurnAndComeBack) {
  const Clip clip = dancer();
  Clip turned = clip;
  turn_y_up_to_z_up(turned);
  EXPECT_LT(largest_distance(clip, turned, [](const Vector3& p, Index) { return Vector3(p.x(), -p.z(), p.y()); }),
            kExact);
  EXPECT_EQ(turned.skeleton.joints[0].channels[2], Channel::kZRotation);
  turn_z_up_to_y_up(turned);
  EXPECT_EQ(turned.translations, clip.translations);
  EXPECT_EQ(turned.rotations, clip.rotations);
}

TEST(AdaptMarkers, PicksScalesAndRefusesARoot) {
  MarkerSet markers;
  markers.names = {"LHEE", "RHEE", "HEAD"};
  markers.metres_per_unit = 0.001;
  markers.positions = FrameMatrix::Constant(4, 9, 100);
  AdaptClipOptions options = with("*HEE", "R*");
  options.scale = 2;
  options.out_unit = LengthUnit::kCm;
  const MarkerSet out = adapt_markers(markers, options);
  EXPECT_EQ(out.names, std::vector<std::string>{"LHEE"});
  EXPECT_NEAR(out.position(0, 0).x(), 20, 1e-12);
  options.root = RootMotion::kInPlace;
  EXPECT_THROW(adapt_markers(markers, options), InvalidInput);
}

TEST(FitsPattern, StarStandsForAnyLetters) {
  EXPECT_TRUE(fits_pattern("Left*", "LeftArm"));
  EXPECT_TRUE(fits_pattern("*Finger*", "LeftFinger1"));
  EXPECT_TRUE(fits_pattern("a*b*c", "axxbyybzzc"));
  EXPECT_TRUE(fits_pattern("*", ""));
  EXPECT_FALSE(fits_pattern("Left", "LeftArm"));
  EXPECT_FALSE(fits_pattern("a*b", "axxbyyc"));
}

}  // namespace
}  // namespace motex
