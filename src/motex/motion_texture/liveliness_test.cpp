// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/liveliness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/motion/stick_figure.h"
#include "motex/motion_texture/instance_walk.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/model_edits.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

/// Mean way of joints and end sites in frames first + 1 … first + count − 1, units a frame.
double mean_way(const FrameMatrix& positions, Index first, Index count) {
  double sum = 0;
  for (Index t = first + 1; t < first + count; ++t)
    for (Index j = 0; j < positions.cols(); j += 3)
      sum += (positions.block<1, 3>(t, j) - positions.block<1, 3>(t - 1, j)).norm();
  return 3 * sum / static_cast<double>((count - 1) * positions.cols());
}

TEST(Liveliness, SpeedsAreThoseOfTheSourceClips) {
  const MotionTexture& model = sample_model();
  const std::vector<double> speeds = mean_speeds(model);
  ASSERT_EQ(speeds.size(), model.instances.size());
  double sum = 0, sum_source = 0;
  for (std::size_t k = 0; k < speeds.size(); ++k) {
    const Instance& x = model.instances[k];
    const auto& run = model.runs[static_cast<std::size_t>(x.run_idx)];
    const FrameMatrix positions = world_positions(sample_clips()[static_cast<std::size_t>(run.clip_idx)]);
    const double source = model.features.cm_per_unit * mean_way(positions, run.clip_start + x.row - run.row, x.length);
    EXPECT_NEAR(speeds[k], source, 0.1 * source);
    sum += speeds[k], sum_source += source;
  }
  EXPECT_NEAR(sum, sum_source, 0.02 * sum_source);
}

TEST(Liveliness, IsZeroOnAverageOverTheFramesAsEdited) {
  MotionTexture model = sample_model();
  model.visit_ratios.assign(model.textons.size(), 1);
  model.visit_ratios[0] = 5;
  const std::vector<double> u = liveliness(model), speeds = mean_speeds(model);
  double sum = 0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const Instance& x = model.instances[k];
    sum += model.visit_ratios[static_cast<std::size_t>(x.texton)] * static_cast<double>(x.length) * u[k];
    EXPECT_NEAR((1 + u[k]) / (1 + u[0]), speeds[k] / speeds[0], 1e-12);
  }
  EXPECT_NEAR(sum, 0, 1e-9);
}

TEST(Liveliness, IsZeroWhereNothingMoves) {
  MotionTexture model = sample_model();
  for (Index t = 1; t < model.corpus.rows(); ++t) model.corpus.row(t) = model.corpus.row(0);
  model.corpus.leftCols(2).setZero();
  model.corpus.col(3).setZero();
  for (const double u : liveliness(model)) EXPECT_EQ(u, 0);
}

/// Learned from clips that stroll and clips that hurry.
MotionTexture uneven_model() {
  std::vector<Clip> clips;
  for (int k = 0; k < 4; ++k) {
    StickFigureOptions figure;
    figure.num_frames = 500;
    figure.speed = k < 2 ? 40 : 140;
    figure.noise = 0.1;
    figure.seed = static_cast<std::uint64_t>(k + 1);
    clips.push_back(walk_stick_figure(figure).clip);
  }
  LearnOptions options;
  options.state_size = 8;
  options.init = Init::kGreedy;
  LearnReport report;
  return learn_motion_texture(clips, options, report);
}

/// Whatever draws the dance to calm examples.
TEST(Liveliness, WalksAreAsLivelyAsTheirSource) {
  const MotionTexture model = uneven_model();
  std::vector<int> danced;
  for (const int texton : danced_textons(model))
    for (const int i : model.textons[static_cast<std::size_t>(texton)].instances) danced.push_back(i);
  const std::vector<double> u = liveliness(model, danced);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SynthesizeOptions options;
    options.seed = seed;
    InstanceWalk walk(model, options, {}, true);
    double sum = 0, frames = 0;
    while (frames < 12000) {
      const int i = walk.next([&](int b) { return std::exp(-3 * u[static_cast<std::size_t>(b)]); });
      const auto length = static_cast<double>(model.instances[static_cast<std::size_t>(i)].length);
      sum += length * u[static_cast<std::size_t>(i)], frames += length;
    }
    EXPECT_NEAR(sum / frames, 0, 0.15) << seed;
  }
}

}  // namespace
}  // namespace motex
