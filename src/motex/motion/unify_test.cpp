// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/unify.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/motion/length_unit.h"

namespace motex {
namespace {

Clip leg(const std::string& name, double thigh, double rate, Index frames = 61) {
  Skeleton skeleton;
  skeleton.joints = {
      {"hips", -1, Vector3::Zero(), {}}, {"knee", 0, Vector3(0, -thigh, 0), {}}, {"foot", 1, Vector3(0, -40, 0), {}}};
  skeleton.end_sites = {{2, Vector3(0, 0, 10)}};
  Clip clip = make_clip(skeleton, frames, 1 / rate);
  clip.name = name;
  for (Index t = 0; t < frames; ++t) clip.set_translation(t, 0, Vector3(static_cast<double>(t) / rate, 90, 0));
  return clip;
}

struct Warnings {
  std::vector<std::string> said;
  JobContext job;
  Warnings() {
    job.on_warning = [this](const std::string& message) { said.push_back(message); };
  }
};

void expect_refused(std::vector<Clip> clips, const std::string& part) {
  try {
    unify_clips(clips);
    ADD_FAILURE() << "no error; expected: " << part;
  } catch (const InvalidInput& e) {
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

TEST(Unify, RefusesOtherSkeletons) {
  Clip renamed = leg("b", 45, 60);
  renamed.skeleton.joints[1].name = "Knee";
  expect_refused({leg("a", 45, 60), renamed}, "of a and b differ: joint 1 is 'knee' in one and 'Knee' in the other");
  expect_refused({leg("a", 45, 60), leg("b", 44, 60), leg("c", 52, 60)},
                 "of a and c differ: the offset of joint 'knee'");
  Clip doubled = leg("b", 45, 60);
  scale_lengths(doubled, 2);
  expect_refused({leg("a", 45, 60), doubled}, "of a and b differ: the offset of joint 'knee'");
}

TEST(Unify, BringsAllToTheFirstUnit) {
  Warnings warnings;
  std::vector<Clip> clips{leg("a", 45, 60), leg("b", 45, 60), leg("c", 45, 60), leg("d", 45, 60)};
  clips[1].skeleton.metres_per_unit = clips[3].skeleton.metres_per_unit = 0.01;
  scale_lengths(clips[1], 0.01);
  scale_lengths(clips[3], 1 / 30.48);
  unify_clips(clips, warnings.job);
  ASSERT_EQ(warnings.said.size(), 2U);
  EXPECT_NE(warnings.said[0].find("b: is in another unit"), std::string::npos) << warnings.said[0];
  EXPECT_NE(warnings.said[1].find("d: is in another unit"), std::string::npos) << warnings.said[1];
  for (const Clip& clip : clips) {
    EXPECT_LT((clip.translations - leg("", 45, 60).translations).cwiseAbs().maxCoeff(), 1e-9) << clip.name;
    EXPECT_DOUBLE_EQ(clip.skeleton.metres_per_unit, 0.01);
  }
}

TEST(Unify, LeavesEqualClipsAlone) {
  Warnings warnings;
  std::vector<Clip> clips{leg("a", 45, 60), leg("b", 45, 60)};
  const std::vector<Clip> before = clips;
  unify_clips(clips, warnings.job);
  EXPECT_TRUE(warnings.said.empty());
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_EQ(clips[c].translations, before[c].translations);
    EXPECT_EQ(clips[c].skeleton.joints[1].offset, before[c].skeleton.joints[1].offset);
  }
}

TEST(Unify, AveragesBones) {
  Warnings warnings;
  std::vector<Clip> clips{leg("a", 44, 60), leg("b", 46, 60)};
  clips[1].skeleton.metres_per_unit = 0.01;
  unify_clips(clips, warnings.job);
  ASSERT_EQ(warnings.said.size(), 1U);
  EXPECT_NE(warnings.said[0].find("up to 4.3 % (joint 'knee')"), std::string::npos) << warnings.said[0];
  for (const Clip& clip : clips) {
    EXPECT_LT((clip.skeleton.joints[1].offset - Vector3(0, -45, 0)).norm(), 1e-12);
    EXPECT_EQ(clip.translation(7, 1), clip.skeleton.joints[1].offset);
    EXPECT_EQ(clip.skeleton.metres_per_unit, 0.01);
    EXPECT_EQ(clip.translation(6, 0), Vector3(0.1, 90, 0));
  }
}

TEST(Unify, JointsThatTravelKeepTheirPlaces) {
  Warnings warnings;
  std::vector<Clip> clips{leg("a", 45, 60), leg("b", 60, 60)};
  clips[1].set_translation(5, 1, Vector3(1, -50, 0));
  const FrameMatrix before = clips[1].translations;
  unify_clips(clips, warnings.job);
  EXPECT_TRUE(warnings.said.empty());
  EXPECT_EQ(clips[1].translations, before);
  EXPECT_EQ(clips[1].skeleton.joints[1].offset, clips[0].skeleton.joints[1].offset);
}

TEST(Unify, LowestRateWins) {
  Warnings warnings;
  std::vector<Clip> clips{leg("a", 45, 60), leg("b", 45, 30), leg("c", 45, 120), leg("d", 45, 30.0001)};
  unify_clips(clips, warnings.job);
  ASSERT_EQ(warnings.said.size(), 1U);
  EXPECT_NE(warnings.said[0].find("2 of 4 were resampled to the lowest, 30.000 Hz"), std::string::npos)
      << warnings.said[0];
  EXPECT_EQ(clips[0].num_frames(), 31);
  EXPECT_EQ(clips[1].num_frames(), 61);
  EXPECT_EQ(clips[2].num_frames(), 16);
  EXPECT_EQ(clips[3].num_frames(), 61);
  for (const Clip& clip : clips) EXPECT_DOUBLE_EQ(clip.frame_time_secs, 1.0 / 30);
  EXPECT_NEAR(clips[2].translation(15, 0).x(), 0.5, 1e-9);
}

}  // namespace
}  // namespace motex
