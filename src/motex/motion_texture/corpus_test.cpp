// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/corpus.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <string>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

std::string message(const std::function<void()>& act) {
  try {
    act();
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "nothing was thrown";
}

testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << text << "' does not say '" << part << "'";
}

TEST(Corpus, TooShortClipsAreNamedWithWhatToDo) {
  std::vector<Clip> clips = walking_clips(1, 72);
  const FeatureSpace space = make_feature_space(clips);
  const std::string one = message([&] { make_corpus(space, clips, 60, false, {}); });
  EXPECT_TRUE(contains(one, "walk_0.bvh is too short"));
  EXPECT_TRUE(contains(one, "--min-duration"));
  EXPECT_TRUE(contains(one, "1.20 s"));
  clips.push_back(slice(clips[0], 0, 40));
  EXPECT_TRUE(contains(message([&] { make_corpus(space, clips, 60, false, {}); }), "and the others"));
  EXPECT_TRUE(contains(message([&] { make_corpus(space, {}, 60, false, {}); }), "no clip"));
}

TEST(Corpus, RunsLieOneAfterAnother) {
  const std::vector<Clip> clips = walking_clips(3, 200);
  const FeatureSpace space = make_feature_space(clips);
  const Corpus corpus = make_corpus(space, clips, 60, false, {});
  ASSERT_EQ(corpus.runs.size(), 3U);
  EXPECT_EQ(corpus.num_glitch_frames, 0);
  EXPECT_EQ(corpus.features.rows(), 600);
  for (int c = 0; c < 3; ++c) {
    const motex::Run& run = corpus.runs[static_cast<std::size_t>(c)];
    EXPECT_EQ(run.clip_idx, c);
    EXPECT_EQ(run.row, 200 * c);
    EXPECT_EQ(corpus.features.middleRows(run.row, run.length), encode(space, clips[static_cast<std::size_t>(c)]));
  }
}

TEST(Corpus, GlitchesSplitRunsAndAreSaid) {
  std::vector<Clip> clips = walking_clips(1, 400);
  const FeatureSpace space = make_feature_space(clips);
  for (Index t = 200; t < 400; ++t) clips[0].set_translation(t, 0, clips[0].translation(t, 0) + Vector3(0, 0, 300));
  std::vector<std::string> warnings;
  JobContext job;
  job.on_warning = [&](const std::string& text) { warnings.push_back(text); };
  const Corpus corpus = make_corpus(space, clips, 60, false, job);
  ASSERT_EQ(corpus.runs.size(), 2U);
  EXPECT_GT(corpus.num_glitch_frames, 0);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(contains(warnings[0], std::to_string(corpus.num_glitch_frames) + " frames of 1 clip "));
  EXPECT_EQ(corpus.features.rows() + corpus.num_glitch_frames, 400);
  for (const Index channel : {0, 1, 3})
    EXPECT_LT(corpus.features.col(channel).cwiseAbs().maxCoeff(), 60 * space.weights[0]) << "the jump is a step";
  const motex::Run& second = corpus.runs[1];
  EXPECT_EQ(second.clip_start + second.length, 400);
  EXPECT_EQ(corpus.features(second.row, 1), corpus.features(second.row + 1, 1));
  EXPECT_EQ(make_corpus(space, clips, 60, true, job).runs.size(), 1U);
}

TEST(Corpus, OtherSkeletonsAndCancelling) {
  std::vector<Clip> clips = walking_clips(2, 200);
  const FeatureSpace space = make_feature_space(clips);
  const std::atomic<bool> cancel{true};
  JobContext job;
  job.cancel = &cancel;
  EXPECT_THROW(make_corpus(space, clips, 60, false, job), Cancelled);
  clips[1].skeleton.joints[2].name = "Skull";
  EXPECT_TRUE(contains(message([&] { make_corpus(space, clips, 60, false, {}); }), "walk_1.bvh"));
}

TEST(Corpus, DistanceOfRandomPosesIsThatOfNormals) {
  Corpus corpus;
  corpus.features.resize(4000, 1);
  Rng rng(3);
  for (Index t = 0; t < 4000; ++t) corpus.features(t, 0) = rng.normal();
  EXPECT_NEAR(random_pose_distance(corpus, 1), std::sqrt(2.0) * 0.6745, 0.06);
  EXPECT_EQ(random_pose_distance(corpus, 1), random_pose_distance(corpus, 1));
}

}  // namespace
}  // namespace motex
