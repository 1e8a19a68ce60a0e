// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/figure.h"

#include <gtest/gtest.h>

#include "motex/motion/stick_figure.h"

namespace motex {
namespace {

TEST(Figure, SidesOfNames) {
  for (const char* name :
       {"LeftArm", "mixamorig:LeftHand", "lShldr", "LHipJoint", "L_Hand", "hand.L", "Bip001 L Hand", "arm_l"})
    EXPECT_EQ(side_of_name(name), Side::kLeft) << name;
  for (const char* name : {"RightArm", "rButtock", "R_Foot", "Bip01 R Thigh", "foot-r", "r"})
    EXPECT_EQ(side_of_name(name), Side::kRight) << name;
  for (const char* name : {"", "Hips", "LowerBack", "lumbar", "Root", "root", "Spine1", "chest", "left_lane:Neck"})
    EXPECT_EQ(side_of_name(name), Side::kMiddle) << name;
}

TEST(Figure, StickFigureHasHandsFeetTrunkAndHead) {
  const Skeleton skeleton = stick_figure_skeleton();
  const Figure figure = make_figure(skeleton);
  EXPECT_EQ(figure.hands[0], skeleton.find("LeftHand"));
  EXPECT_EQ(figure.feet[1], skeleton.find("RightFoot"));
  EXPECT_EQ(figure.head_idx, skeleton.find("Head"));
  int trunks = 0;
  for (const BodyPart& part : figure.parts) {
    trunks += part.balls.size() >= 3 ? 1 : 0;
    for (const Ball& ball : part.balls) {
      EXPECT_GE(ball.point_idx, 0);
      EXPECT_LT(ball.point_idx, figure.num_points);
      EXPECT_GT(ball.radius, 0);
    }
  }
  EXPECT_EQ(trunks, 2);
}

TEST(Figure, UnnamedBodiesAreThinLimbs) {
  Skeleton chain;
  chain.joints = {{"a", -1, {0, 0, 0}, {}}, {"b", 0, {0, 1, 0}, {}}, {"c", 1, {0, 1, 0}, {}}};
  chain.end_sites = {{2, {0, 0.5, 0}}};
  const Figure figure = make_figure(chain);
  EXPECT_EQ(figure.parts.size(), 3U);
  EXPECT_EQ(figure.num_points, 4);
  EXPECT_EQ(facing(figure, figure_points(figure, make_clip(chain, 1, 0.1)), 0), Vector3::UnitZ());
}

TEST(Figure, FacesWhereItWalksAndStandsOnTheFloor) {
  StickFigureOptions options;
  options.num_frames = 200;
  const Clip clip = walk_stick_figure(options).clip;
  const Figure figure = make_figure(clip.skeleton);
  const FrameMatrix points = figure_points(figure, clip);
  EXPECT_GT(facing(figure, points, 50).z(), 0.9);
  EXPECT_NEAR(floor_height(points), 0, 2);
}

}  // namespace
}  // namespace motex
