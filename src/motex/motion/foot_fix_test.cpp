// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/foot_fix.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/motion/stick_figure.h"

namespace motex {
namespace {

/// The walk on a path that is longer by that factor than its steps: planted feet slide.
Clip sliding_walk(const StickFigure& figure, double factor) {
  Clip clip = figure.clip;
  for (Index t = 0; t < clip.num_frames(); ++t) {
    const Vector3 p = clip.translation(t, 0);
    clip.set_translation(t, 0, {factor * p.x(), p.y(), factor * p.z()});
  }
  return clip;
}

/// Mean horizontal cm/s of the ankles in the middle of true stances (four frames from their ends).
double stance_slide(const StickFigure& figure, const Clip& clip) {
  const FrameMatrix positions = world_positions(clip);
  double sum = 0;
  Index num = 0;
  for (int foot = 0; foot < 2; ++foot) {
    const int x = 3 * clip.skeleton.find(foot == 0 ? "LeftFoot" : "RightFoot");
    for (Index t = 30; t + 30 < clip.num_frames(); ++t) {
      if (!figure.is_planted(t - 4, foot) || !figure.is_planted(t, foot) || !figure.is_planted(t + 4, foot)) continue;
      sum += std::hypot(positions(t, x) - positions(t - 1, x), positions(t, x + 2) - positions(t - 1, x + 2)) /
             clip.frame_time_secs;
      ++num;
    }
  }
  return sum / static_cast<double>(num);
}

class FootFixTest : public testing::Test {
 protected:
  StickFigureOptions options_ = [] {
    StickFigureOptions options;
    options.turn_rate = 0.2;
    options.noise = 0.05;
    return options;
  }();
  StickFigure figure_ = walk_stick_figure(options_);
  FootModel model_ = learn_foot_model({&figure_.clip, 1});
};

TEST_F(FootFixTest, RefusesWhatDoesNotFit) {
  FootModel wrong = model_;
  wrong.legs[0].knee_idx = 0;
  EXPECT_THROW(FootFixer(wrong, figure_.clip.skeleton, 1.0 / 60), InvalidInput);
  FootFixOptions options;
  options.lookahead = 2;
  EXPECT_THROW(FootFixer(model_, figure_.clip.skeleton, 1.0 / 60, options), InvalidInput);
  Clip clip = figure_.clip;
  const Index beyond = clip.num_frames();
  EXPECT_THROW(fix_feet(clip, model_, {}, {&beyond, 1}), InvalidInput);
}

TEST_F(FootFixTest, HoldsFeetThatSlide) {
  Clip clip = sliding_walk(figure_, 1.1);
  const double before = stance_slide(figure_, clip);
  EXPECT_GT(before, 9);
  const FootFixReport report = fix_feet(clip, model_);
  check_clip(clip);
  EXPECT_LT(stance_slide(figure_, clip), 0.2 * before);
  EXPECT_EQ(report.num_frames, 600);
  EXPECT_NEAR(report.contact_speed_before, 10, 1);
  EXPECT_LT(report.contact_speed_after, 0.2 * report.contact_speed_before);
  EXPECT_LT(report.max_correction, 10);
  EXPECT_GE(report.num_contacts, 36);
}

TEST_F(FootFixTest, LeavesCleanFeetAlmostAlone) {
  Clip clip = figure_.clip;
  const FootFixReport report = fix_feet(clip, model_);
  EXPECT_LT(report.mean_correction, 0.2);
  EXPECT_LT(report.max_correction, 0.4);
  EXPECT_LT((world_positions(clip) - world_positions(figure_.clip)).cwiseAbs().maxCoeff(), 1);
}

TEST_F(FootFixTest, KeepsTheFootsRotationAndTheBody) {
  Clip clip = sliding_walk(figure_, 1.1);
  const Clip source = clip;
  fix_feet(clip, model_);
  Pose before, after;
  for (Index t = 0; t < clip.num_frames(); t += 7) {
    forward_kinematics(source, t, before);
    forward_kinematics(clip, t, after);
    for (const char* name : {"LeftFoot", "RightToeBase", "Head", "LeftHand"}) {
      const int j = clip.skeleton.find(name);
      EXPECT_LT(angle_between(before.rotation(j), after.rotation(j)), 1e-6) << name << ' ' << t;
    }
  }
}

TEST_F(FootFixTest, StreamGivesTheSameBytesLateByLessThanHalfASecond) {
  Clip whole = sliding_walk(figure_, 1.1);
  const Clip source = whole;
  fix_feet(whole, model_);
  FootFixer fixer(model_, source.skeleton, source.frame_time_secs);
  EXPECT_LE(fixer.delay(), 30);
  Clip streamed = make_clip(source.skeleton, source.num_frames(), source.frame_time_secs);
  Index out = 0;
  for (Index t = 0; t < source.num_frames(); ++t) {
    fixer.push(source, t);
    while (fixer.pop(streamed, out)) ++out;
    EXPECT_EQ(out, std::max<Index>(0, t + 1 - fixer.delay()));
  }
  fixer.finish();
  while (fixer.pop(streamed, out)) ++out;
  EXPECT_EQ(out, source.num_frames());
  EXPECT_EQ(streamed.rotations, whole.rotations);
  EXPECT_EQ(streamed.translations, whole.translations);
  EXPECT_THROW(fixer.push(source, 0), InvalidInput);
}

TEST_F(FootFixTest, RefusesToBeFedWithoutBeingRead) {
  FootFixer fixer(model_, figure_.clip.skeleton, figure_.clip.frame_time_secs);
  const auto feed = [&] {
    for (Index t = 0; t < 100; ++t) fixer.push(figure_.clip, t);
  };
  EXPECT_THROW(feed(), InvalidInput);
}

TEST_F(FootFixTest, PinnedFramesDoNotChangeAndTheirNeighboursHardly) {
  Clip clip = sliding_walk(figure_, 1.1);
  const Clip source = clip;
  std::vector<Index> pinned;
  for (Index t = 200; t < 220; ++t) pinned.push_back(t);
  fix_feet(clip, model_, {}, pinned);
  EXPECT_EQ(clip.rotations.middleRows(200, 20), source.rotations.middleRows(200, 20));
  EXPECT_EQ(clip.translations.middleRows(200, 20), source.translations.middleRows(200, 20));
  const FrameMatrix moved = world_positions(clip) - world_positions(source);
  EXPECT_LT(moved.row(199).cwiseAbs().maxCoeff(), 1);
  EXPECT_LT(moved.row(220).cwiseAbs().maxCoeff(), 1);
  EXPECT_GT(moved.cwiseAbs().maxCoeff(), 1);
}

TEST_F(FootFixTest, WithoutLegsNothingChanges) {
  Clip clip = figure_.clip;
  const FootFixReport report = fix_feet(clip, FootModel{});
  EXPECT_EQ(clip.rotations, figure_.clip.rotations);
  EXPECT_EQ(report.num_contacts, 0);
  EXPECT_EQ(FootFixer(FootModel{}, clip.skeleton, 0.01).delay(), 0);
}

TEST_F(FootFixTest, ShortClipsPass) {
  for (const Index frames : {1, 2, 5}) {
    Clip clip = slice(figure_.clip, 0, frames);
    EXPECT_EQ(fix_feet(clip, model_).num_frames, frames);
    check_clip(clip);
  }
}

}  // namespace
}  // namespace motex
