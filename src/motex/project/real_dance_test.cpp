// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/synthesize.h"
#include "motex/project/load_clips.h"
#include "motex/project/motion_texture_file.h"

/// The whole road on a real dance: the bundled clip of 12 seconds.
namespace motex {
namespace {

std::vector<Clip> real_dance() {
  return load_clips({std::filesystem::path(MOTEX_TEST_DATA) / "mocap/quickstart/salsa_cmu61_10.bvh"});
}

double largest_step(const Clip& clip) {
  const FrameMatrix p = world_positions(clip);
  const FrameMatrix steps = p.bottomRows(p.rows() - 1) - p.topRows(p.rows() - 1);
  double largest = 0;
  for (Index c = 0; c < steps.cols(); c += 3)
    largest = std::max(largest, steps.middleCols<3>(c).rowwise().norm().maxCoeff());
  return largest;
}

TEST(RealDance, IsLearnedAndDancedOn) {
  const std::vector<Clip> clips = real_dance();
  LearnReport report;
  const MotionTexture model = learn_motion_texture(clips, {}, report);
  EXPECT_GT(report.num_textons, 1);
  EXPECT_GE(report.num_segments, report.num_textons);
  EXPECT_EQ(model.feet.legs.size(), 2U);
  for (std::size_t i = 1; i < report.objective.size(); ++i)
    EXPECT_GE(report.objective[i], report.objective[i - 1] - 1e-6 * std::abs(report.objective[i]));
  const ScoreReport score = score_clips(model, clips);
  EXPECT_GT(score.log_likelihood_per_frame, score.global_lds_log_likelihood_per_frame);

  const auto heights = clips[0].translations.col(3 * model.features.travelling_joint + 1);
  const double margin = 5 / model.features.cm_per_unit;
  for (const std::uint64_t seed : {1, 2}) {
    SynthesizeOptions options;
    options.seed = seed;
    SynthesizeReport played;
    const Clip dance = synthesize_motion(model, 2000, {}, options, played);
    check_clip(dance);
    EXPECT_EQ(dance.num_frames(), 2000);
    EXPECT_LT(largest_step(dance), 1.2 * largest_step(clips[0])) << "seed " << seed;
    const auto height = dance.translations.col(3 * model.features.travelling_joint + 1);
    EXPECT_GT(height.minCoeff(), heights.minCoeff() - margin);
    EXPECT_LT(height.maxCoeff(), heights.maxCoeff() + margin);
    EXPECT_LT(played.longest_copy, clips[0].num_frames());
  }
}

TEST(RealDance, OwnBasisGivesTheSameModelForAnyNumberOfThreads) {
  const std::vector<Clip> clips = real_dance();
  LearnOptions options;
  options.basis = Basis::kOwn;
  options.max_iterations = 5;
  LearnReport report;
  JobContext one, two;
  one.jobs = 1, two.jobs = 2;
  const std::string bytes = motion_texture_bytes(learn_motion_texture(clips, options, report, one));
  EXPECT_EQ(motion_texture_bytes(learn_motion_texture(clips, options, report, two)), bytes);
  EXPECT_EQ(motion_texture_bytes(parse_motion_texture(bytes, "again")), bytes);
}

}  // namespace
}  // namespace motex
