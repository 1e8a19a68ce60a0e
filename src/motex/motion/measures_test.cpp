// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/motion/stick_figure.h"

namespace motex {
namespace {

StickFigureOptions walk_options(std::uint64_t seed) {
  StickFigureOptions options;
  options.noise = 0.15;
  options.turn_rate = 0.3;
  options.seed = seed;
  return options;
}

class MeasuresTest : public testing::Test {
 protected:
  Clip walk_ = walk_stick_figure(walk_options(1)).clip;
  Clip other_ = walk_stick_figure(walk_options(2)).clip;
};

TEST_F(MeasuresTest, RefusesWhatCannotBeCompared) {
  EXPECT_THROW(compare_motion({}, walk_), InvalidInput);
  EXPECT_THROW(compare_motion({&walk_, 1}, slice(walk_, 0, 50)), InvalidInput);
  const Clip brief = slice(walk_, 0, 50);
  EXPECT_THROW(compare_motion({&brief, 1}, walk_), InvalidInput);
  Clip renamed = walk_;
  renamed.skeleton.joints[3].name = "Wing";
  EXPECT_THROW(compare_motion({&walk_, 1}, renamed), InvalidInput);
  const ClipRange beyond{0, 500, 101}, absent{1, 0, 100};
  EXPECT_THROW(compare_motion({&walk_, 1}, {&beyond, 1}, walk_), InvalidInput);
  EXPECT_THROW(compare_motion({&walk_, 1}, {&absent, 1}, walk_), InvalidInput);
  CompareOptions options;
  options.threshold = -1;
  EXPECT_THROW(compare_motion({&walk_, 1}, walk_, options), InvalidInput);
}

TEST_F(MeasuresTest, AClipAgainstItselfIsAllOnesAndZeros) {
  const CompareReport report = compare_motion({&walk_, 1}, walk_);
  EXPECT_EQ(report.coverage, 1);
  EXPECT_LT(report.global_diversity, 1e-6);
  EXPECT_LT(report.local_diversity, 1e-6);
  for (const double ratio : {report.jerk_ratio, report.contact_speed_ratio, report.pose_jump_ratio, report.speed_ratio})
    EXPECT_EQ(ratio, 1);
  EXPECT_EQ(report.num_glitch_frames, 0);
  EXPECT_EQ(report.num_reference_windows, 300 - 30 + 1);
  EXPECT_NEAR(report.reference.height_min, 82.5, 0.05);
  EXPECT_NEAR(report.reference.height_max, 85.5, 0.05);
  for (const std::string& foot : report.feet) EXPECT_NE(foot.find("Toe"), std::string::npos) << foot;
}

TEST_F(MeasuresTest, RawValuesAreTheirDefinitions) {
  // A body that only travels has no jerk and no pose jump; all joints share its speed.
  Clip glide = make_clip(walk_.skeleton, 200, walk_.frame_time_secs);
  for (Index t = 0; t < 200; ++t) glide.set_translation(t, 0, Vector3(static_cast<double>(t), 80, 0));
  const MotionMeasures m = compare_motion({&walk_, 1}, glide).generated;
  EXPECT_NEAR(m.speed, 60, 1e-9);
  EXPECT_NEAR(m.contact_speed, 60, 1e-9);
  EXPECT_EQ(m.contact_share, 1);
  EXPECT_NEAR(m.pose_jump, 0, 1e-9);
  EXPECT_NEAR(m.jerk, 0, 1e-6);

  // One joint that turns once: the tip of the head, 20 cm from it, moves by a chord.
  Clip nod = glide;
  const int head = nod.skeleton.find("Head");
  for (Index t = 100; t < 200; ++t)
    nod.set_rotation(t, head, Quat(Eigen::AngleAxisd(0.5, Vector3::UnitX())) * nod.rotation(t, head));
  EXPECT_NEAR(compare_motion({&walk_, 1}, nod).generated.pose_jump, 60 * 2 * 20 * std::sin(0.25), 1e-9);
  CompareOptions joints_only;
  joints_only.tips = false;
  EXPECT_NEAR(compare_motion({&walk_, 1}, nod, joints_only).generated.pose_jump, 0, 1e-9);
}

TEST_F(MeasuresTest, SlidingFeetAndShakyPosesShow) {
  Clip sliding = walk_, shaky = walk_;
  for (Index t = 0; t < sliding.num_frames(); ++t) {
    const Vector3 p = sliding.translation(t, 0);
    sliding.set_translation(t, 0, {1.2 * p.x(), p.y(), 1.2 * p.z()});
    if (t % 2 == 0) shaky.set_rotation(t, 1, shaky.rotation(t, 1) * Quat(Eigen::AngleAxisd(0.05, Vector3::UnitX())));
  }
  const CompareReport slid = compare_motion({&walk_, 1}, sliding);
  EXPECT_GT(slid.contact_speed_ratio, 1.3);
  EXPECT_NEAR(slid.jerk_ratio, 1, 1e-6);
  EXPECT_LT(slid.global_diversity, 1e-6);
  const CompareReport shaken = compare_motion({&walk_, 1}, shaky);
  EXPECT_GT(shaken.jerk_ratio, 2);
  EXPECT_GT(shaken.pose_jump_ratio, 1.05);
}

TEST_F(MeasuresTest, GlitchesOfTheReferenceAreLeftOut) {
  Clip popped = walk_;
  popped.set_translation(200, 0, popped.translation(200, 0) + Vector3(0, 30, 0));
  popped.rotations.row(0) = make_clip(popped.skeleton, 1, 1).rotations.row(0);
  const CompareReport report = compare_motion({&popped, 1}, walk_);
  EXPECT_GE(report.num_glitch_frames, 3);
  EXPECT_LT(report.reference.height_max, 90);
  EXPECT_LE(report.reference.num_frames, 600 - 10 - 1);
  EXPECT_NEAR(report.pose_jump_ratio, 1, 1e-9);
  CompareOptions keep;
  keep.keep_glitches = true;
  EXPECT_GT(compare_motion({&popped, 1}, walk_, keep).reference.height_max, 110);
}

TEST_F(MeasuresTest, PartsOfTheReferenceCountAlone) {
  const std::vector<Clip> both = {walk_, other_};
  const Clip part = slice(other_, 100, 200);
  const std::vector<ClipRange> used = {{1, 100, 200}};
  const CompareReport report = compare_motion(both, used, part);
  EXPECT_EQ(report.coverage, 1);
  EXPECT_EQ(report.jerk_ratio, 1);
  EXPECT_EQ(report.reference.num_frames, 200);
  CompareOptions strict;
  strict.threshold = 0.2;
  EXPECT_EQ(compare_motion(both, used, part, strict).coverage, 1);
  EXPECT_LT(compare_motion(both, part, strict).coverage, 0.8);
}

TEST_F(MeasuresTest, TheRateOfTheGeneratedClipHardlyMatters) {
  StickFigureOptions options = walk_options(1);
  options.frame_rate = 120;
  options.num_frames = 1200;
  const CompareReport report = compare_motion({&walk_, 1}, walk_stick_figure(options).clip);
  EXPECT_GT(report.coverage, 0.99);
  EXPECT_LT(report.global_diversity, 1e-3);
  EXPECT_NEAR(report.speed_ratio, 1, 0.01);
  EXPECT_NEAR(report.pose_jump_ratio, 1, 0.02);
}

}  // namespace
}  // namespace motex
