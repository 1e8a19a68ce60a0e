// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/learn.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "motex/core/error.h"
#include "motex/motion_texture/synthesize.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

LearnOptions small_options() {
  LearnOptions options;
  options.state_size = 6;
  return options;
}

std::string message(const std::function<void()>& act) {
  try {
    act();
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "nothing was thrown";
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Learn, WrongInputIsNamed) {
  LearnReport report;
  const LearnOptions options = small_options();
  EXPECT_THROW(learn_motion_texture({}, options, report), InvalidInput);
  const std::vector<Clip> brief = walking_clips(1, 72), one_frame = walking_clips(1, 1);
  EXPECT_TRUE(says(message([&] { learn_motion_texture(brief, options, report); }), "walk_0.bvh is too short"));
  EXPECT_TRUE(says(message([&] { learn_motion_texture(one_frame, options, report); }), "walk_0.bvh: has 1 frames"));
  std::vector<Clip> clips = walking_clips(2, 300);
  clips[1].skeleton.joints[3].name = "Wing";
  EXPECT_TRUE(says(message([&] { learn_motion_texture(clips, options, report); }), "Wing"));
  clips = walking_clips(2, 300);
  clips[1].frame_time_secs = 1.0 / 30;
  EXPECT_TRUE(says(message([&] { learn_motion_texture(clips, options, report); }), "frame rates"));
  clips = walking_clips(1, 300);
  clips[0].frame_time_secs = 1e-5;
  EXPECT_TRUE(says(message([&] { learn_motion_texture(clips, options, report); }), "--fps"));
  clips = walking_clips(1, 300);
  clips[0].rotations(100, 5) = NAN;
  EXPECT_THROW(learn_motion_texture(clips, options, report), InvalidInput);
  clips = walking_clips(1, 300);
  LearnOptions wrong = options;
  wrong.max_duration = 1.5;
  EXPECT_TRUE(says(message([&] { learn_motion_texture(clips, wrong, report); }), "max_duration"));
  wrong = options;
  wrong.state_size = 1;
  EXPECT_TRUE(says(message([&] { learn_motion_texture(clips, wrong, report); }), "state_size"));
}

void expect_whole_model(const MotionTexture& model, const LearnReport& report) {
  EXPECT_EQ(report.num_textons, static_cast<int>(model.textons.size()));
  EXPECT_EQ(report.num_segments, static_cast<int>(model.instances.size()));
  EXPECT_GE(report.num_components, 1);
  EXPECT_GT(report.largest_component, 0);
  EXPECT_TRUE(model.corpus.allFinite());
  Index row = 0;
  std::size_t listed = 0;
  for (const Instance& x : model.instances) {
    EXPECT_EQ(x.row, row);
    row += x.length;
  }
  EXPECT_EQ(row, model.corpus.rows());
  for (std::size_t i = 0; i < model.textons.size(); ++i) {
    const Texton& texton = model.textons[i];
    EXPECT_TRUE(texton.dynamics.transition.allFinite() && texton.dynamics.noise_cov.allFinite());
    EXPECT_FALSE(texton.instances.empty());
    listed += texton.instances.size();
    for (const int k : texton.instances)
      EXPECT_EQ(model.instances.at(static_cast<std::size_t>(k)).texton, static_cast<int>(i));
  }
  EXPECT_EQ(listed, model.instances.size());
  for (std::size_t i = 1; i < report.objective.size(); ++i)
    EXPECT_GE(report.objective[i], report.objective[i - 1] - 1e-6 * std::abs(report.objective[i]));
}

TEST(Learn, GivesAWholeModelInEveryWay) {
  const std::vector<Clip> clips = walking_clips(3, 500);
  for (const Basis basis : {Basis::kShared, Basis::kOwn})
    for (const Init init : {Init::kMerge, Init::kGreedy}) {
      LearnOptions options = small_options();
      options.basis = basis;
      options.init = init;
      LearnReport report;
      const MotionTexture model = learn_motion_texture(clips, options, report);
      expect_whole_model(model, report);
      EXPECT_EQ(report.num_frames, 1500);
      EXPECT_EQ(report.num_clips, 3);
      const Instance& first = model.instances[0];
      EXPECT_NEAR(first.place.z, clips[0].translation(0, 0).z(), 1e-9);
      const ScoreReport score = score_clips(model, clips);
      EXPECT_TRUE(std::isfinite(score.log_likelihood_per_frame));
      EXPECT_GT(score.log_likelihood_per_frame, score.global_lds_log_likelihood_per_frame);
      EXPECT_EQ(score.num_frames, 1500 - 3 * 2);
    }
}

TEST(Learn, DoesNotDependOnThreads) {
  const std::vector<Clip> clips = walking_clips(3, 400);
  JobContext one, two;
  one.jobs = 1, two.jobs = 2;
  LearnReport a, b;
  const MotionTexture x = learn_motion_texture(clips, small_options(), a, one);
  const MotionTexture y = learn_motion_texture(clips, small_options(), b, two);
  EXPECT_EQ(a.objective, b.objective);
  ASSERT_EQ(x.textons.size(), y.textons.size());
  for (std::size_t i = 0; i < x.textons.size(); ++i)
    EXPECT_EQ(x.textons[i].dynamics.transition, y.textons[i].dynamics.transition);
}

TEST(Learn, CancelsAtEveryStageAndProgressNeverFalls) {
  const std::vector<Clip> clips = walking_clips(2, 300);
  std::atomic<bool> cancel{true};
  JobContext job;
  job.cancel = &cancel;
  LearnReport report;
  EXPECT_THROW(learn_motion_texture(clips, small_options(), report, job), Cancelled);
  for (const Init init : {Init::kMerge, Init::kGreedy}) {
    LearnOptions options = small_options();
    options.init = init;
    double before = 0;
    std::vector<std::string> stages;
    cancel = false;
    job.on_progress = [&](std::string_view stage, double share) {
      EXPECT_GE(share, before);
      before = share;
      if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
    };
    learn_motion_texture(clips, options, report, job);
    EXPECT_EQ(before, 1);
    ASSERT_GE(stages.size(), 4U);
    stages.pop_back();
    for (const std::string& stop_at : stages) {
      cancel = false;
      job.on_progress = [&](std::string_view stage, double) { cancel = cancel || stage == stop_at; };
      EXPECT_THROW(learn_motion_texture(clips, options, report, job), Cancelled) << stop_at;
    }
    job.on_progress = {};
  }
}

TEST(Learn, FramesThatAreAllAlikeGiveAModelOrOneClearError) {
  const Clip still = slice(walking_clips(1, 1)[0], 0, 1);
  Clip clip = make_clip(still.skeleton, 300, still.frame_time_secs);
  clip.name = "still.bvh";
  clip.rotations.rowwise() = still.rotations.row(0);
  clip.translations.rowwise() = still.translations.row(0);
  for (const Basis basis : {Basis::kShared, Basis::kOwn})
    for (const Init init : {Init::kMerge, Init::kGreedy}) {
      LearnOptions options;
      options.basis = basis;
      options.init = init;
      LearnReport report;
      try {
        const MotionTexture model = learn_motion_texture({&clip, 1}, options, report);
        expect_whole_model(model, report);
        SynthesizeReport played;
        const Clip dance = synthesize_motion(model, 300, {}, {}, played);
        check_clip(dance);
        EXPECT_LT((world_positions(dance).row(299) - world_positions(clip).row(0)).norm(), 1);
      } catch (const InvalidInput&) {
      } catch (const NumericalFailure&) {
      }
    }
}

TEST(Segment, RecognisesTheTrainingClips) {
  const std::vector<Clip> clips = walking_clips(3, 500);
  LearnReport report;
  LearnOptions options = small_options();
  options.init = Init::kGreedy;
  const MotionTexture model = learn_motion_texture(clips, options, report);
  ASSERT_GT(model.textons.size(), 1U);
  Index row = 0, agree = 0;
  for (const Clip& clip : clips) {
    Index end = 0;
    for (const RecognisedSegment& s : segment_clip(model, clip)) {
      EXPECT_EQ(s.start, end);
      end += s.length;
      EXPECT_TRUE(std::isfinite(s.log_likelihood_per_frame));
      for (const Instance& x : model.instances)
        if (x.texton == s.texton)
          agree += std::max<Index>(0, std::min(x.row + x.length, row + end) - std::max(x.row, row + s.start));
    }
    EXPECT_EQ(end, clip.num_frames());
    row += clip.num_frames();
  }
  EXPECT_GT(static_cast<double>(agree), 0.9 * static_cast<double>(row));
}

TEST(Segment, ShortAndForeignClips) {
  std::vector<Clip> clips = walking_clips(2, 400);
  LearnReport report;
  const MotionTexture model = learn_motion_texture(clips, small_options(), report);
  EXPECT_EQ(segment_clip(model, slice(clips[0], 0, 20)).size(), 1U) << "shorter than a segment: one";
  for (const Index few : {1, 2}) EXPECT_THROW(segment_clip(model, slice(clips[0], 0, few)), InvalidInput);
  EXPECT_THROW(score_clips(model, {}), InvalidInput);
  const Clip brief = slice(clips[0], 0, 50);
  EXPECT_THROW(score_clips(model, {&brief, 1}), InvalidInput);
  clips[0].frame_time_secs = 1.0 / 25;
  EXPECT_THROW(segment_clip(model, clips[0]), InvalidInput);
}

}  // namespace
}  // namespace motex
