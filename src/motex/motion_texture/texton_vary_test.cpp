// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/texton_vary.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/motion_texture/synthetic.h"
#include "motex/motion_texture/texton_stretch.h"

namespace motex {
namespace {

TEST(Vary, WrongInputIsRefused) {
  VaryReport report;
  EXPECT_THROW(vary_texton(sample_model(), -1, {}, report), InvalidInput);
  EXPECT_THROW(vary_texton(sample_model(), 1 << 20, {}, report), InvalidInput);
  VaryOptions options;
  options.noise = 0;
  EXPECT_THROW(vary_texton(sample_model(), 0, options, report), InvalidInput);
}

TEST(Vary, EndsStayAndTheMiddleDoesNot) {
  const MotionTexture& model = sample_model();
  VaryOptions options;
  options.foot_fix = false;
  for (int i = 0; i < static_cast<int>(model.instances.size()); ++i) {
    VaryReport report;
    const Clip example = example_clip(model, i), clip = vary_texton(model, i, options, report);
    const Index l = example.num_frames();
    ASSERT_EQ(clip.num_frames(), l);
    for (const Index t : {Index{0}, Index{1}, l - 2, l - 1})
      EXPECT_EQ(clip.rotations.row(t).tail(4), example.rotations.row(t).tail(4));
    EXPECT_GT(report.mean_distance, 0);
    EXPECT_GT(report.largest_distance, report.mean_distance);
    EXPECT_GT(report.farthest_frame, 1);
    EXPECT_LT(report.farthest_frame, l - 2);
  }
}

TEST(Vary, OtherSeedsAreOtherVariants) {
  VaryReport report;
  VaryOptions options;
  const Clip first = vary_texton(sample_model(), 1, options, report);
  EXPECT_EQ(vary_texton(sample_model(), 1, options, report).rotations, first.rotations);
  options.seed = 2;
  EXPECT_NE(vary_texton(sample_model(), 1, options, report).rotations, first.rotations);
}

TEST(Vary, MoreNoiseGoesFarther) {
  VaryReport report;
  VaryOptions options;
  double before = 0;
  for (const double noise : {1e-3, 0.1, 0.6, 2.0}) {
    options.noise = noise;
    vary_texton(sample_model(), 1, options, report);
    EXPECT_GT(report.mean_distance, before);
    before = report.mean_distance;
  }
}

}  // namespace
}  // namespace motex
