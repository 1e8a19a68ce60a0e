// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "motex/motion/clip.h"

namespace motex {

enum class Side { kMiddle, kLeft, kRight };

/// A ball at a point of the body.
struct Ball {
  int point_idx = 0;
  double radius = 0;  ///< in the skeleton's unit
};

/// The convex hull of its balls: one is a head, two are a limb, more are a trunk.
struct BodyPart {
  std::vector<Ball> balls;
  Side side = Side::kMiddle;
};

/// A body for pictures: which points to join, how thick, and which of them are hands and feet. Hands and feet are found
/// by name (hand or wrist, foot or ankle; left or right in the usual spellings); the two joints above each are elbow
/// and shoulder, knee and hip. Whatever has no such name is drawn as thin limbs.
struct Figure {
  Index num_points = 0;  ///< joints, end sites, then the head's centre if there is one
  std::vector<BodyPart> parts;
  std::array<int, 2> hands{-1, -1}, feet{-1, -1};      ///< left, right; −1 = not found
  std::array<int, 2> shoulders{-1, -1}, hips{-1, -1};  ///< left, right
  int head_idx = -1, head_tip_idx = -1;                ///< the head's centre lies on the line through both
  double head_place = 0;                               ///< centre = head + place · (tip − head)
  double height = 1;                                   ///< of the standing body, in the skeleton's unit
};

Figure make_figure(const Skeleton& skeleton);

/// The side that a joint's name tells: "LeftArm", "mixamorig:LeftArm", "lShldr", "L_Hand", "hand.L", "Bip001 L Hand".
Side side_of_name(const std::string& name);

/// World positions of the figure's points: frames × 3·num_points.
FrameMatrix figure_points(const Figure& figure, const Clip& clip);

/// Horizontal unit vector into which a frame's hips (or shoulders) look: left × up. +Z when the body has neither.
Vector3 facing(const Figure& figure, const FrameMatrix& points, Index frame);

/// A body that moves, ready to be drawn: what a clip and what markers become.
struct FigureMotion {
  std::string name;
  double frame_time_secs = 1.0 / 60;
  Figure figure;
  FrameMatrix points;  ///< frames × 3·num_points; NaN: not seen
};
FigureMotion figure_motion(const Clip& clip);

/// Height of the floor: the 2nd percentile of each frame's lowest point that is not NaN.
double floor_height(const FrameMatrix& points);

}  // namespace motex
