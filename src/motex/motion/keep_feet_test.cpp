// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/keep_feet.h"

#include <gtest/gtest.h>

#include <array>

#include "motex/core/error.h"
#include "motex/motion/stick_figure.h"

namespace motex {
namespace {

struct Walk {
  Clip clip;
  FootModel feet;
};

Walk walk() {
  StickFigureOptions options;
  options.num_frames = 240;
  Walk out{walk_stick_figure(options).clip, {}};
  out.feet = learn_foot_model(std::array{out.clip});
  return out;
}

TEST(KeepFeet, ALoweredBodyGoesIntoItsKnees) {
  const Walk base = walk();
  ASSERT_EQ(base.feet.legs.size(), 2U);
  Clip clip = base.clip;
  const int pelvis = base.feet.pelvis_idx;
  for (Index t = 100; t < 140; ++t) clip.set_translation(t, pelvis, clip.translation(t, pelvis) - Vector3(0, 6, 0));
  keep_feet(base.clip, base.feet, clip);
  Pose before, after;
  for (Index t = 0; t < clip.num_frames(); ++t) {
    forward_kinematics(base.clip, t, before);
    forward_kinematics(clip, t, after);
    for (const Leg& leg : base.feet.legs) {
      EXPECT_LT((before.positions.col(leg.ankle_idx) - after.positions.col(leg.ankle_idx)).norm(), 1.0)
          << "frame " << t;
      EXPECT_LT(angle_between(before.rotation(leg.ankle_idx), after.rotation(leg.ankle_idx)), 1e-6);
    }
    if (t < 100 || t >= 140) {
      EXPECT_EQ(clip.rotations.row(t), base.clip.rotations.row(t));
    }
  }
}

TEST(KeepFeet, OtherClipsAreRefused) {
  const Walk base = walk();
  Clip shorter = slice(base.clip, 0, 10);
  EXPECT_THROW(keep_feet(base.clip, base.feet, shorter), InvalidInput);
}

}  // namespace
}  // namespace motex
