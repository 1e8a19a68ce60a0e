// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/held_out.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "motex/motion/stick_figure.h"
#include "motex/project/sweep.h"

namespace motex {
namespace {

std::vector<Clip> walks(int count, Index num_frames) {
  std::vector<Clip> clips;
  for (int i = 0; i < count; ++i) {
    StickFigureOptions options;
    options.num_frames = num_frames;
    options.noise = 0.1;
    options.turn_rate = 0.2 * i;
    options.seed = static_cast<std::uint64_t>(i + 1);
    clips.push_back(walk_stick_figure(options).clip);
    clips.back().name = std::string(1, static_cast<char>('a' + i));
  }
  return clips;
}

std::string names(const std::vector<Clip>& clips) {
  std::string text;
  for (const Clip& clip : clips) text += clip.name;
  return text;
}

TEST(SplitClips, NeedsClips) {
  EXPECT_THROW(split_clips({}), InvalidInput);
  EXPECT_THROW(split_clips(walks(2, 5), -1), InvalidInput);
}

TEST(SplitClips, EveryFourthByNameWhateverTheOrder) {
  std::vector<Clip> clips = walks(9, 5);
  std::reverse(clips.begin(), clips.end());
  EXPECT_EQ(names(split_clips(clips).held_out), "aei");
  EXPECT_EQ(names(split_clips(clips).training), "bcdfgh");
  EXPECT_EQ(names(split_clips(clips, 1).held_out), "dh");
}

TEST(SplitClips, OneOfFewClips) {
  EXPECT_EQ(names(split_clips(walks(3, 5)).held_out), "c");
  EXPECT_EQ(names(split_clips(walks(3, 5), 1).held_out), "b");
  EXPECT_EQ(names(split_clips(walks(2, 5)).training), "a");
}

TEST(SplitClips, QuartersOfOneClipCoverIt) {
  const std::vector<Clip> one = walks(1, 101);
  Index total = 0;
  for (int split = 0; split < 4; ++split) {
    const HeldOutSplit parts = split_clips(one, split);
    Index frames = 0;
    for (const Clip& clip : parts.training) frames += clip.num_frames();
    ASSERT_EQ(parts.held_out.size(), 1U);
    EXPECT_EQ(frames + parts.held_out[0].num_frames(), 101);
    total += parts.held_out[0].num_frames();
  }
  EXPECT_EQ(total, 101);
  EXPECT_EQ(split_clips(one).held_out[0].rotations.bottomRows<1>(), one[0].rotations.bottomRows<1>());
}

TEST(HeldOutScore, IsThatOfTheHeldOutClips) {
  LearnOptions options;
  options.state_size = 6;
  const std::vector<Clip> clips = walks(4, 400);
  const HeldOutReport report = held_out_score(clips, 1, options);
  EXPECT_EQ(report.held_out_clips, std::vector<std::string>{"c"});
  LearnReport learned;
  const std::vector<Clip> training{clips[0], clips[1], clips[3]};
  const MotionTexture model = learn_motion_texture(training, options, learned);
  const ScoreReport score = score_clips(model, {&clips[2], 1});
  EXPECT_DOUBLE_EQ(report.log_likelihood_per_frame, score.log_likelihood_per_frame);
  EXPECT_DOUBLE_EQ(report.global_lds_log_likelihood_per_frame, score.global_lds_log_likelihood_per_frame);
  EXPECT_EQ(report.num_frames, score.num_frames);
  EXPECT_TRUE(std::isfinite(report.noise_only_log_likelihood_per_frame));
}

TEST(CountParameters, CountsByHand) {
  MotionTexture model;
  Subspace subspace;
  subspace.mean = Vector::Zero(5);
  subspace.basis = Matrix::Zero(5, 2);
  model.subspaces = {subspace};
  Texton texton;
  texton.dynamics.offset = Vector::Zero(2);
  model.textons = {texton, texton, texton};
  // Mean 5, basis 5·2 − 3, deviation 1; a texton 8 + 2 + 3; transitions 3·2.
  EXPECT_DOUBLE_EQ(count_parameters(model), 5 + 7 + 1 + 3 * 13 + 6);
  model.options.common_dynamics = true;
  EXPECT_DOUBLE_EQ(count_parameters(model), 5 + 7 + 1 + 8 + 3 * 5 + 6);
}

TEST(Sweep, PointsComeInOrderAndHoldTheirFormulas) {
  LearnOptions options;
  options.state_size = 6;
  options.max_iterations = 5;
  options.path_weight = 0;  // thresholds are nats
  const HeldOutSplit split = split_clips(walks(4, 400));
  const auto points = sweep_threshold(split, {300, 3, 30}, options);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[0].threshold, 3);
  EXPECT_EQ(points[2].threshold, 300);
  EXPECT_LT(points[0].num_textons, points[2].num_textons) << "what must gain more is merged less";
  for (const SweepPoint& point : points) {
    EXPECT_FALSE(point.is_auto);
    EXPECT_LE(point.min_length_secs, point.mean_length_secs);
    EXPECT_LE(point.mean_length_secs, point.max_length_secs);
    const double n = static_cast<double>(point.num_frames);
    EXPECT_NEAR(point.bic, n * point.training_log_likelihood_per_frame - point.num_parameters / 2 * std::log(n),
                1e-6 * std::abs(point.bic));
    EXPECT_GT(point.mdl, -n * point.training_log_likelihood_per_frame);
    EXPECT_LT(point.mdl, -point.bic + 10 * point.num_segments);
  }
  const std::string csv = sweep_csv(points);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  EXPECT_GT(draw_sweep(points, "nats").shapes.size(), 50U);
}

}  // namespace
}  // namespace motex
