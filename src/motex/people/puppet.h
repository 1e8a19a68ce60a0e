// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "motex/image/image.h"
#include "motex/people/sprite.h"

namespace motex {

/// Points of a body that a puppet is drawn through. Left is the actor's own.
enum class PuppetJoint {
  kHead,
  kFace,  ///< in front of the middle of the head: says which way it looks
  kNeck,
  kPelvis,
  kLeftShoulder,
  kLeftElbow,
  kLeftWrist,
  kLeftFingers,
  kLeftHip,
  kLeftKnee,
  kLeftAnkle,
  kLeftToes,
  kRightShoulder,
  kRightElbow,
  kRightWrist,
  kRightFingers,
  kRightHip,
  kRightKnee,
  kRightAnkle,
  kRightToes,
};
constexpr int kNumPuppetJoints = 20;

struct PuppetPoint {
  double x = 0, y = 0;            ///< pixels of the frame
  double depth_metres = 0;        ///< away from the camera: what is less hides what is more
  double pixels_per_metre = 150;  ///< at that depth
};

/// A body as the camera sees it.
struct PuppetPose {
  std::array<PuppetPoint, kNumPuppetJoints> joints;
  const PuppetPoint& at(PuppetJoint joint) const { return joints[static_cast<std::size_t>(joint)]; }
  PuppetPoint& at(PuppetJoint joint) { return joints[static_cast<std::size_t>(joint)]; }
};

struct PuppetLook {
  Rgba skin{224, 172, 140, 255}, hair{60, 40, 30, 255}, shirt{170, 40, 60, 255}, stripes{235, 225, 210, 255},
      trousers{50, 60, 110, 255}, shoes{40, 38, 40, 255};
  double girth = 1;  ///< 1 = usual
};

/// Looks that can be told from one another; none has the green or the blue of a screen.
PuppetLook puppet_look(int number);

/// Light that a coloured screen throws on the edges of who stands before it.
struct SpillLight {
  Rgba colour{};
  double amount = 0;        ///< 0 … 1, at the very edge
  double reach_pixels = 6;  ///< inwards, to 1/e
};

/// A figure of capsules: trunk in a striped shirt, sleeves, trousers, shoes, hands, head with hair; shaded as by a lamp
/// at the top left. Alpha is that of a straight edge through the pixel, exact to the distance from the outline:
/// clamp(½ − distance). What lies outside the frame is cut off.
Sprite draw_puppet(const PuppetPose& pose, const PuppetLook& look, int width, int height, const SpillLight& spill = {});

}  // namespace motex
