// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/inbetween_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "motex/core/error.h"

namespace motex {
namespace {

/// Two joints: one that travels, one 2 above it.
Clip two_joints(Index frames) {
  Skeleton skeleton;
  skeleton.joints.resize(2);
  skeleton.joints[0].name = "root";
  skeleton.joints[1].name = "tip";
  skeleton.joints[1].parent_idx = 0;
  skeleton.joints[1].offset = Vector3(0, 2, 0);
  return make_clip(skeleton, frames, 1.0 / 30);
}

Quat about_x(double angle) { return {std::cos(angle / 2), std::sin(angle / 2), 0, 0}; }

TEST(InbetweenMeasures, AGapOutsideTheClipIsAnError) {
  const Clip clip = two_joints(10);
  EXPECT_THROW(interpolate_gap(clip, 0, 3), InvalidInput);
  EXPECT_THROW(hold_gap(clip, 7, 3), InvalidInput);
  InbetweenMeasures measures(Vector::Ones(6), 0);
  EXPECT_THROW(measures.add(clip, two_joints(9), 1), InvalidInput);
  EXPECT_THROW(window_position_deviations(std::vector<Clip>{clip}, 0), InvalidInput);
}

TEST(InbetweenMeasures, TheTruthHasNoError) {
  Clip clip = two_joints(12);
  for (Index t = 0; t < 12; ++t) {
    clip.set_translation(t, 0, Vector3(0.3 * static_cast<double>(t), 1, 0));
    clip.set_rotation(t, 1, about_x(0.5 * static_cast<double>(t)));
  }
  Clip made = slice(clip, 2, 8);
  made.rotations *= -1;  // the same rotations
  InbetweenMeasures measures(Vector::Ones(6), 0);
  measures.add(clip, made, 2);
  EXPECT_NEAR(measures.errors().l2p, 0, 1e-12);
  EXPECT_NEAR(measures.errors().l2q, 0, 1e-12);
  EXPECT_NEAR(measures.errors().npss, 0, 1e-12);
  EXPECT_EQ(measures.errors().num_gaps, 1);
}

TEST(InbetweenMeasures, ErrorsAreThoseDoneByHand) {
  const Clip clip = two_joints(8);
  Clip made = slice(clip, 2, 4);
  for (Index t = 0; t < 4; ++t) made.set_translation(t, 0, Vector3(0, 3, 0));
  for (Index t = 0; t < 4; ++t) made.set_rotation(t, 1, about_x(std::numbers::pi / 2));
  Vector deviations = Vector::Ones(6);
  deviations[1] = 0.5;
  InbetweenMeasures measures(deviations, 0);
  measures.add(clip, made, 2);
  EXPECT_NEAR(measures.errors().l2p, std::hypot(6, 3), 1e-12);  // the root by 3/0.5, the tip by 3
  EXPECT_NEAR(measures.errors().l2q, std::hypot(1 - std::sqrt(0.5), std::sqrt(0.5)), 1e-12);
  EXPECT_NEAR(measures.errors().npss, 0, 1e-12);  // both stand still: all power is in the mean
}

TEST(InbetweenMeasures, SpectraOfOneWaveAgainstStillness) {
  // One quaternion component is cos(π t) about its mean, the other follows: known power at k = 2 of n = 4.
  Clip clip = two_joints(6);
  for (Index t = 0; t < 6; ++t) clip.set_rotation(t, 1, about_x(t % 2 == 0 ? 1.0 : -1.0));
  Clip made = slice(clip, 1, 4);
  for (Index t = 0; t < 4; ++t) made.set_rotation(t, 1, Quat::Identity());
  InbetweenMeasures measures(Vector::Ones(6), 0);
  measures.add(clip, made, 1);
  // x is ± sin ½: all its power 16 sin² ½ at k = 2, the still series' counts as in the mean: moved by 2 bins.
  const double x = 16 * std::pow(std::sin(0.5), 2), others = 16 * (1 + std::pow(std::cos(0.5), 2));
  EXPECT_NEAR(measures.errors().npss, 2 * x / (x + others), 1e-12);
}

TEST(InbetweenMeasures, NeitherPlaceNorHeadingMatters) {
  Clip clip = two_joints(10), made = two_joints(8);
  for (Index t = 0; t < 8; ++t) made.set_translation(t, 0, Vector3(0, 0, 0.1 * static_cast<double>(t)));
  Vector deviations = Vector::LinSpaced(6, 1, 2);
  InbetweenMeasures here(deviations, 0), there(deviations, 0);
  here.add(clip, made, 1);
  const Quat turn(std::cos(0.7), 0, std::sin(0.7), 0);
  for (Clip* c : {&clip, &made})
    for (Index t = 0; t < c->num_frames(); ++t) {
      c->set_translation(t, 0, turn * c->translation(t, 0) + Vector3(5, 0, -3));
      c->set_rotation(t, 0, turn * c->rotation(t, 0));
    }
  there.add(clip, made, 1);
  EXPECT_GT(here.errors().l2p, 0.1);
  EXPECT_NEAR(here.errors().l2p, there.errors().l2p, 1e-9);
}

TEST(InbetweenMeasures, DeviationsAreOfPlacedWindows) {
  Clip clip = two_joints(70);
  for (Index t = 0; t < 70; ++t) clip.set_translation(t, 0, Vector3(100, 1, static_cast<double>(t)));
  const Vector deviations = window_position_deviations(std::vector<Clip>{clip}, 0);
  EXPECT_NEAR(deviations[2], std::sqrt((65.0 * 65 - 1) / 12), 1e-9);  // z = −9 … 55
  EXPECT_LT(deviations[0], 1e-4);
  EXPECT_NEAR(deviations[5], deviations[2], 1e-12);
}

TEST(InbetweenMeasures, Baselines) {
  Clip clip = two_joints(6);
  clip.set_translation(0, 0, Vector3(1, 0, 0));
  clip.set_translation(4, 0, Vector3(5, 0, 0));
  clip.set_rotation(4, 1, about_x(1.0));
  const Clip straight = interpolate_gap(clip, 1, 3), held = hold_gap(clip, 1, 3);
  EXPECT_NEAR(straight.translation(0, 0).x(), 2, 1e-12);
  EXPECT_NEAR(angle_between(straight.rotation(1, 1), about_x(0.5)), 0, 1e-7);
  EXPECT_NEAR(held.translation(2, 0).x(), 1, 1e-12);
  EXPECT_NEAR(angle_between(held.rotation(2, 1), about_x(0)), 0, 1e-7);
}

}  // namespace
}  // namespace motex
