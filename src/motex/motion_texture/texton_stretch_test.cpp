// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/texton_stretch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

MotionTexture walking_model() {
  LearnOptions options;
  options.state_size = 6;
  LearnReport report;
  return learn_motion_texture(walking_clips(3, 400), options, report);
}

double largest_turn(const Clip& a, Index row_a, const Clip& b, Index row_b) {
  double largest = 0;
  for (int j = 0; j < a.skeleton.num_joints(); ++j)
    if (j != 0) largest = std::max(largest, angle_between(a.rotation(row_a, j), b.rotation(row_b, j)));
  return largest;
}

TEST(Stretch, WrongInputIsRefused) {
  const MotionTexture model = walking_model();
  StretchReport report;
  EXPECT_THROW(stretch_texton(model, -1, 100, {}, report), InvalidInput);
  EXPECT_THROW(stretch_texton(model, static_cast<int>(model.instances.size()), 100, {}, report), InvalidInput);
  EXPECT_THROW(stretch_texton(model, 0, 3, {}, report), InvalidInput);
  EXPECT_THROW(stretch_texton(model, 0, 1'000'000, {}, report), InvalidInput);
  StretchOptions options;
  options.noise = -1;
  EXPECT_THROW(stretch_texton(model, 0, 100, options, report), InvalidInput);
}

TEST(Stretch, KeepsTheSpeedAndTheEndsAtAnyLength) {
  const MotionTexture model = walking_model();
  for (int i = 0; i < static_cast<int>(model.instances.size()); i += 9) {
    const Clip example = example_clip(model, i);
    const Index l = example.num_frames();
    for (const double factor : {0.8, 1.0, 1.48, 2.0}) {
      const auto n = static_cast<Index>(factor * static_cast<double>(l));
      StretchReport report;
      const Clip clip = stretch_texton(model, i, n, {}, report);
      ASSERT_EQ(clip.num_frames(), n);
      EXPECT_NEAR(report.speed_ratio, 1, 0.05) << "example " << i << " x " << factor;
      EXPECT_NEAR(mean_joint_speed(clip), report.speed_ratio * mean_joint_speed(example), 1e-9);
      for (const Index t : {0, 1}) {
        EXPECT_LT(largest_turn(clip, t, example, t), 1e-5);
        EXPECT_LT(largest_turn(clip, n - 2 + t, example, l - 2 + t), 1e-5);
      }
      EXPECT_EQ(report.visits.front().source_start, 0);
      EXPECT_EQ(report.visits.back().start + report.visits.back().length, n);
    }
  }
}

TEST(Stretch, AWarpIsSlower) {
  const MotionTexture model = walking_model();
  StretchOptions options;
  options.method = StretchMethod::kWarp;
  options.foot_fix = false;
  StretchReport report;
  const Index l = model.instances[0].length;
  EXPECT_EQ(stretch_texton(model, 0, 3 * l / 2, options, report).num_frames(), 3 * l / 2);
  EXPECT_NEAR(report.speed_ratio, 2.0 / 3, 0.05);
  stretch_texton(model, 0, l, options, report);
  EXPECT_NEAR(report.speed_ratio, 1, 1e-6);
}

TEST(Stretch, RepeatsWithItsSeed) {
  const MotionTexture model = walking_model();
  for (const StretchMethod method : {StretchMethod::kRevisit, StretchMethod::kWhite}) {
    StretchOptions options;
    options.method = method;
    StretchReport report;
    const Clip once = stretch_texton(model, 0, 150, options, report);
    EXPECT_EQ(stretch_texton(model, 0, 150, options, report).rotations, once.rotations);
    options.seed = 2;
    EXPECT_NE(stretch_texton(model, 0, 150, options, report).rotations, once.rotations);
  }
}

TEST(Stretch, VeryShortOnesAreMadeToo) {
  const MotionTexture model = walking_model();
  StretchReport report;
  std::vector<std::string> said;
  JobContext job;
  job.on_warning = [&](const std::string& text) { said.push_back(text); };
  for (const Index n : {4, 5, 9, 20}) EXPECT_EQ(stretch_texton(model, 0, n, {}, report, job).num_frames(), n);
  EXPECT_FALSE(said.empty()) << "4 frames cannot go as slowly as the example";
}

}  // namespace
}  // namespace motex
