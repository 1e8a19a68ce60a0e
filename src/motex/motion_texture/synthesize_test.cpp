// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/synthesize.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <utility>

#include "motex/core/error.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

const std::vector<Clip>& clips() { return sample_clips(); }
const MotionTexture& model() { return sample_model(); }

Clip dance(Index frames, const SynthesizeOptions& options = {}, const std::vector<int>& path = {}) {
  SynthesizeReport report;
  return synthesize_motion(model(), frames, path, options, report);
}

double largest_step(const Clip& clip, Index first = 1) {
  const FrameMatrix p = world_positions(clip);
  double largest = 0;
  for (Index t = first; t < p.rows(); ++t)
    largest = std::max(
        largest, (p.row(t) - p.row(t - 1)).reshaped<Eigen::RowMajor>(p.cols() / 3, 3).rowwise().norm().maxCoeff());
  return largest;
}

TEST(Synthesize, WrongInputIsRefused) {
  SynthesizeReport report;
  const int none = static_cast<int>(model().textons.size());
  EXPECT_THROW(synthesize_motion(model(), 0, {}, {}, report), InvalidInput);
  EXPECT_THROW(synthesize_motion(model(), -1, {0}, {}, report), InvalidInput);
  EXPECT_THROW(synthesize_motion(model(), 100, {none}, {}, report), InvalidInput);
  EXPECT_THROW(synthesize_motion(model(), Index{1} << 40, {}, {}, report), InvalidInput);
  SynthesizeOptions options;
  options.noise = -1;
  EXPECT_THROW(synthesize_motion(model(), 100, {}, options, report), InvalidInput);
  EXPECT_THROW(synthesize_unconstrained(model(), none, 100, {}, report), InvalidInput);
  EXPECT_THROW(synthesize_unconstrained(model(), -1, 100, {}, report), InvalidInput);
  EXPECT_THROW(synthesize_unconstrained(model(), 0, 1, {}, report), InvalidInput);
  EXPECT_THROW(synthesize_unconstrained(model(), 0, Index{1} << 40, {}, report), InvalidInput);
  EXPECT_THROW(synthesize_unconstrained(model(), 0, 100, options, report), InvalidInput);
}

TEST(Synthesize, GivesExactlyTheFramesAskedFor) {
  for (const bool foot_fix : {false, true})
    for (const Index frames : {1, 2, 59, 600, 3000}) {
      SynthesizeOptions options;
      options.foot_fix = foot_fix;
      SynthesizeReport report;
      const Clip clip = synthesize_motion(model(), frames, {}, options, report);
      EXPECT_EQ(clip.num_frames(), frames);
      check_clip(clip);
      EXPECT_EQ(clip.frame_time_secs, 1.0 / 60);
      Index end = 0;
      for (const PlayedTexton& played : report.played) {
        EXPECT_EQ(played.start, end);
        end += played.length;
        EXPECT_EQ(model().instances.at(static_cast<std::size_t>(played.instance)).texton, played.texton);
      }
      EXPECT_EQ(end, frames);
      EXPECT_LE(report.longest_copy, frames);
      EXPECT_GE(report.longest_copy, std::min<Index>(frames, 60));
    }
}

TEST(Synthesize, PathsArePlayedAsAsked) {
  ASSERT_GE(model().textons.size(), 3U);
  const std::vector<int> path{1, 0, 2, 2, 1};
  for (const bool foot_fix : {false, true}) {
    SynthesizeOptions options;
    options.foot_fix = foot_fix;
    SynthesizeReport report;
    const Clip clip = synthesize_motion(model(), 0, path, options, report);
    ASSERT_EQ(report.played.size(), path.size());
    for (std::size_t k = 0; k < path.size(); ++k) EXPECT_EQ(report.played[k].texton, path[k]);
    EXPECT_EQ(report.played.back().start + report.played.back().length, clip.num_frames());
    EXPECT_TRUE(clip.rotations.allFinite());
  }
  const std::vector<int> long_path(60, 0);
  SynthesizeReport report;
  EXPECT_GT(synthesize_motion(model(), 0, long_path, {}, report).num_frames(), 60 * 50);
  EXPECT_EQ(report.played.size(), 60U);
  synthesize_motion(model(), 1000, path, {}, report);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(report.played[k].texton, path[k]);
}

TEST(Synthesize, PosesAtJoinsAreThoseOfTheExamples) {
  SynthesizeOptions options;
  options.foot_fix = options.floor_fix = false;
  SynthesizeReport report;
  const Clip clip = synthesize_motion(model(), 2000, {}, options, report);
  const FrameMatrix y = encode(model().features, clip);
  for (const PlayedTexton& played : report.played) {
    if (played.start + 2 > clip.num_frames()) continue;
    const Index row = model().instances[static_cast<std::size_t>(played.instance)].row;
    for (const Index k : {0, 1}) {
      if (played.start + k == 0) continue;  // encode() has no step before the first frame
      EXPECT_LT((y.row(played.start + k) - model().corpus.row(row + k).cast<double>()).cwiseAbs().maxCoeff(), 1e-6);
    }
  }
}

TEST(Synthesize, NoJumpIsLargerThanTheExamples) {
  double source = 0;
  for (const Clip& clip : clips()) source = std::max(source, largest_step(clip));
  for (const std::uint64_t seed : {1, 2, 3}) {
    SynthesizeOptions options;
    options.seed = seed;
    EXPECT_LT(largest_step(dance(3000, options)), 1.3 * source) << "seed " << seed;
  }
}

TEST(Synthesize, HeightStaysInsideTheExamples) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Clip& clip : clips()) {
    low = std::min(low, clip.translations.col(1).minCoeff());
    high = std::max(high, clip.translations.col(1).maxCoeff());
  }
  const Clip clip = dance(5000);
  EXPECT_GT(clip.translations.col(1).minCoeff(), low - 5);
  EXPECT_LT(clip.translations.col(1).maxCoeff(), high + 5);
}

TEST(Synthesize, EveryModeIsFiniteAndRepeatsWithItsSeed) {
  for (const NoiseSource source : {NoiseSource::kReplay, NoiseSource::kWhite})
    for (const KeyPoses key_poses : {KeyPoses::kNearest, KeyPoses::kRandom}) {
      SynthesizeOptions options;
      options.noise_source = source;
      options.key_poses = key_poses;
      options.seed = 5;
      const Clip a = dance(1000, options), b = dance(1000, options);
      check_clip(a);
      EXPECT_EQ(a.rotations, b.rotations);
      EXPECT_EQ(a.translations, b.translations);
      options.seed = 6;
      EXPECT_NE(a.rotations, dance(1000, options).rotations);
    }
}

TEST(Synthesize, TheStreamIsTheSameDance) {
  for (const bool foot_fix : {false, true}) {
    SynthesizeOptions options;
    options.foot_fix = foot_fix;
    SynthesizeReport report;
    const Clip whole = synthesize_motion(model(), 1500, {}, options, report);
    Synthesizer made(model(), options);
    Synthesizer stream = std::move(made);
    Clip frame = make_output_clip(model(), 1);
    std::vector<PlayedTexton> played;
    for (Index t = 0; t < 1500; ++t) {
      ASSERT_TRUE(stream.next(frame, 0));
      ASSERT_EQ(frame.rotations.row(0), whole.rotations.row(t)) << t;
      ASSERT_EQ(frame.translations.row(0), whole.translations.row(t)) << t;
      const auto begun = stream.take_played();
      EXPECT_LE(begun.size(), 2U) << "what was taken is gone";
      played.insert(played.end(), begun.begin(), begun.end());
    }
    ASSERT_GE(played.size(), report.played.size());
    for (std::size_t k = 0; k < report.played.size(); ++k) EXPECT_EQ(played[k].instance, report.played[k].instance);
    EXPECT_TRUE(stream.take_played().empty());
  }
}

TEST(Synthesize, AStreamOfAPathEnds) {
  Synthesizer stream(model(), {}, {0, 1}, false);
  Clip frame = make_output_clip(model(), 1);
  Index frames = 0;
  while (stream.next(frame, 0)) ++frames;
  EXPECT_FALSE(stream.next(frame, 0));
  EXPECT_EQ(frames, dance(0, {}, {0, 1}).num_frames());
}

TEST(Synthesize, UnconstrainedTextonsAreFinite) {
  for (int i = 0; i < static_cast<int>(model().textons.size()); ++i) {
    SynthesizeReport report;
    const Clip clip = synthesize_unconstrained(model(), i, 300, {}, report);
    check_clip(clip);
    EXPECT_EQ(clip.num_frames(), 300);
    ASSERT_EQ(report.played.size(), 1U);
    EXPECT_EQ(report.played[0].texton, i);
    EXPECT_EQ(report.played[0].length, 300);
    EXPECT_EQ(clip.rotations, synthesize_unconstrained(model(), i, 300, {}, report).rotations);
  }
  MotionTexture unstable = model();
  unstable.textons[0].dynamics.transition *= 3;
  SynthesizeReport report;
  EXPECT_THROW(synthesize_unconstrained(unstable, 0, 5000, {}, report), NumericalFailure);
}

TEST(Synthesize, CanBeCancelled) {
  const std::atomic<bool> cancel{true};
  JobContext job;
  job.cancel = &cancel;
  SynthesizeReport report;
  EXPECT_THROW(synthesize_motion(model(), 5000, {}, {}, report, job), Cancelled);
}

}  // namespace
}  // namespace motex
