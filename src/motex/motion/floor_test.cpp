// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/floor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/motion/stick_figure.h"

namespace motex {
namespace {

class FloorTest : public testing::Test {
 protected:
  /// The walk, sunk by that many cm between frames 100 and 140, smoothly.
  Clip sunk(double cm) const {
    Clip clip = figure_.clip;
    for (Index t = 80; t < 160; ++t) {
      const double u = std::min(1.0, static_cast<double>(std::min(t - 80, 160 - t)) / 20);
      clip.set_translation(t, 0, clip.translation(t, 0) - Vector3(0, cm * u * u * (3 - 2 * u), 0));
    }
    return clip;
  }
  double deepest(const Clip& clip, Index first, Index last) const {
    Vector depths(3);
    Pose pose;
    double most = 0;
    for (Index t = first; t < last; ++t) {
      forward_kinematics(clip, t, pose);
      depths_below_floor(clip.skeleton, model_, pose, depths);
      most = std::max(most, depths.maxCoeff());
    }
    return most;
  }
  static double largest_bend(const Clip& clip) {
    const FrameMatrix p = world_positions(clip);
    double largest = 0;
    for (Index t = 1; t + 1 < p.rows(); ++t)
      largest = std::max(largest, (p.row(t + 1) - 2 * p.row(t) + p.row(t - 1)).cwiseAbs().maxCoeff());
    return largest;
  }

  StickFigure figure_ = walk_stick_figure({.num_frames = 300});
  FootModel model_ = learn_foot_model({&figure_.clip, 1});
};

TEST_F(FloorTest, RefusesWhatDoesNotFit) {
  FootModel wrong = model_;
  wrong.legs[0].ankle_idx = 99;
  EXPECT_THROW(FloorFixer(wrong, figure_.clip.skeleton, 1.0 / 60), InvalidInput);
  Clip clip = figure_.clip;
  const Index beyond = 300;
  EXPECT_THROW(keep_above_floor(clip, model_, {&beyond, 1}), InvalidInput);
}

TEST_F(FloorTest, AWalkOnTheFloorStaysAsItIs) {
  Clip clip = figure_.clip;
  const FloorReport report = keep_above_floor(clip, model_);
  EXPECT_EQ(report.num_frames, 300);
  EXPECT_LT(report.largest_lift, 0.2) << "of the frames below the 2nd percentile alone";
  EXPECT_LT((clip.rotations - figure_.clip.rotations).cwiseAbs().maxCoeff(), 0.05);
}

TEST_F(FloorTest, NothingStaysBelow) {
  for (const double cm : {1.0, 4.0, 9.0}) {
    const Clip before = sunk(cm);
    Clip clip = before;
    ASSERT_GT(deepest(before, 0, 300), 0.8 * cm);
    const FloorReport report = keep_above_floor(clip, model_);
    EXPECT_LT(deepest(clip, 0, 300), 0.1) << cm;
    EXPECT_GT(report.num_below_before, 30);
    EXPECT_EQ(report.num_below_after, 0) << cm;
    EXPECT_NEAR(report.deepest_before, deepest(before, 0, 300), 1e-9);
    EXPECT_NEAR(report.deepest_after, deepest(clip, 0, 300), 1e-9);
    EXPECT_LT(report.largest_lift, 1.2 * report.deepest_before + 0.1);
    EXPECT_LT(largest_bend(clip), 2 * largest_bend(before)) << cm;
    EXPECT_LT((clip.rotations.topRows(60) - before.rotations.topRows(60)).cwiseAbs().maxCoeff(), 0.05);
  }
}

TEST_F(FloorTest, HandsAreLiftedWithTheBody) {
  Clip clip = figure_.clip;
  for (Index t = 0; t < 300; ++t) {  // bows with hanging arms until the hands are under the floor
    const double bow = 2.8 * std::exp(-std::pow(static_cast<double>(t - 150) / 30, 2));
    clip.set_rotation(t, clip.skeleton.find("Spine"), exp_map(Vector3(bow, 0, 0)));
    clip.set_rotation(t, clip.skeleton.find("LeftArm"), exp_map(Vector3(-bow, 0, 0)));
  }
  ASSERT_GT(deepest(clip, 0, 300), 2);
  keep_above_floor(clip, model_);
  EXPECT_LT(deepest(clip, 0, 300), 0.1);
}

TEST_F(FloorTest, PinnedFramesStay) {
  const Clip before = sunk(5);
  Clip clip = before;
  const std::vector<Index> pinned{118, 119};
  keep_above_floor(clip, model_, pinned);
  for (const Index t : pinned) {
    EXPECT_EQ(clip.rotations.row(t), before.rotations.row(t));
    EXPECT_EQ(clip.translations.row(t), before.translations.row(t));
  }
  EXPECT_LT(deepest(clip, 132, 300), 0.1);
}

TEST_F(FloorTest, TheStreamIsTheSame) {
  Clip whole = sunk(5), out = make_clip(whole.skeleton, 1, whole.frame_time_secs);
  const Clip before = whole;
  keep_above_floor(whole, model_);
  FloorFixer fixer(model_, before.skeleton, before.frame_time_secs);
  Index popped = 0;
  const auto take = [&] {
    while (fixer.pop(out, 0)) {
      ASSERT_EQ(out.rotations.row(0), whole.rotations.row(popped)) << popped;
      ASSERT_EQ(out.translations.row(0), whole.translations.row(popped)) << popped;
      ++popped;
    }
  };
  for (Index t = 0; t < before.num_frames(); ++t) {
    fixer.push(before, t);
    take();
    EXPECT_LE(t - popped, 12);
  }
  fixer.finish();
  take();
  EXPECT_EQ(popped, 300);
}

}  // namespace
}  // namespace motex
