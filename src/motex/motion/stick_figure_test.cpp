// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/stick_figure.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"

namespace motex {
namespace {

TEST(StickFigure, RefusesStepsLongerThanItsLegs) {
  StickFigureOptions options;
  options.step_length = 120;
  EXPECT_THROW(walk_stick_figure(options), InvalidInput);
  options.step_length = 50;
  options.num_frames = 0;
  EXPECT_THROW(walk_stick_figure(options), InvalidInput);
}

TEST(StickFigure, PlantedFeetStandExactlyStillAndFlat) {
  StickFigureOptions options;
  options.turn_rate = 0.4;
  options.noise = 0.1;
  const StickFigure figure = walk_stick_figure(options);
  check_clip(figure.clip);
  const FrameMatrix positions = world_positions(figure.clip);
  Index planted_steps = 0;
  for (int f = 0; f < 2; ++f) {
    const int ankle = figure.clip.skeleton.find(f == 0 ? "LeftFoot" : "RightFoot");
    for (Index t = 1; t < options.num_frames; ++t) {
      const auto step = positions.block<1, 6>(t, 3 * ankle) - positions.block<1, 6>(t - 1, 3 * ankle);
      if (figure.is_planted(t, f) && figure.is_planted(t - 1, f)) {
        ++planted_steps;
        EXPECT_LT(step.norm(), 1e-10) << t;
        EXPECT_NEAR(positions(t, 3 * ankle + 1), 8, 1e-10);
        EXPECT_NEAR(positions(t, 3 * (ankle + 1) + 1), 2, 1e-10);
      } else {
        EXPECT_LT(step.norm(), 15) << t;
      }
    }
  }
  EXPECT_NEAR(static_cast<double>(planted_steps) / static_cast<double>(2 * options.num_frames), 0.6, 0.05);
}

TEST(StickFigure, TravelsAtItsSpeedAndRepeatsWithItsSeed) {
  StickFigureOptions options;
  options.noise = 0.1;
  const StickFigure a = walk_stick_figure(options), b = walk_stick_figure(options);
  EXPECT_EQ(a.clip.rotations, b.clip.rotations);
  options.seed = 2;
  EXPECT_NE(a.clip.rotations, walk_stick_figure(options).clip.rotations);
  EXPECT_NEAR(a.clip.translation(599, 0).z(), 100 * 599 / 60.0, 1e-9);
}

TEST(StickFigure, HeightIsGuessedFromHeadToToeAndNotToTheHand) {
  Skeleton skeleton = stick_figure_skeleton();
  EXPECT_EQ(metres_per_unit_or_guess(skeleton), 0.01);
  skeleton.metres_per_unit = 0;
  const double guess = metres_per_unit_or_guess(skeleton);
  EXPECT_NEAR(guess, 0.01, 0.0015);
  // Longer arms, held up no higher than the head, do not make a taller body.
  skeleton.joints[static_cast<std::size_t>(skeleton.find("LeftForeArm"))].offset = Vector3(90, 5, 0);
  EXPECT_EQ(metres_per_unit_or_guess(skeleton), guess);
}

}  // namespace
}  // namespace motex
