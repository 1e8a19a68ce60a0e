// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/inbetween.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "motex/motion/inbetween_measures.h"
#include "motex/motion/stick_figure.h"
#include "motex/motion_texture/placing.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

/// A walk that the sample model was not learned from.
const Clip& new_walk() {
  static const Clip clip = [] {
    StickFigureOptions options;
    options.num_frames = 400;
    options.speed = 105;
    options.turn_rate = 0.2;
    options.noise = 0.05;
    options.seed = 77;
    Clip walk = walk_stick_figure(options).clip;
    walk.name = "new walk";
    return walk;
  }();
  return clip;
}

InbetweenOptions without_feet(InbetweenAim aim = InbetweenAim::kLively) {
  InbetweenOptions options;
  options.aim = aim;
  options.foot_fix = false;
  return options;
}

Clip filled(const Clip& clip, Index first, Index count, const InbetweenOptions& options) {
  InbetweenReport report;
  return inbetween(sample_model(), slice(clip, 0, first), slice(clip, first + count, clip.num_frames() - first - count),
                   count, options, report);
}

TEST(Inbetween, BadRequests) {
  const Clip& clip = new_walk();
  InbetweenReport report;
  EXPECT_THROW(inbetween(sample_model(), clip, clip, 0, {}, report), InvalidInput);
  EXPECT_THROW(inbetween(sample_model(), slice(clip, 0, 0), clip, 5, {}, report), InvalidInput);
  EXPECT_THROW(inbetween(sample_model(), clip, clip, 5000, {}, report), InvalidInput);
  InbetweenOptions options;
  options.context = 0;
  EXPECT_THROW(inbetween(sample_model(), clip, clip, 5, options, report), InvalidInput);
  Clip other = clip;
  other.skeleton.joints[1].name = "somebody else's";
  EXPECT_THROW(inbetween(sample_model(), other, clip, 5, {}, report), InvalidInput);
}

TEST(Inbetween, NearerToTheTruthThanInterpolation) {
  const Clip& clip = new_walk();
  const Vector deviations = window_position_deviations(sample_clips(), 0);
  for (const InbetweenAim aim : {InbetweenAim::kLively, InbetweenAim::kMean})
    for (const Index gap : {20, 60}) {
      InbetweenMeasures ours(deviations, 0), straight(deviations, 0);
      for (const Index first : {60, 110, 160, 210}) {
        ours.add(clip, filled(clip, first, gap, without_feet(aim)), first);
        straight.add(clip, interpolate_gap(clip, first, gap), first);
      }
      EXPECT_LT(ours.errors().l2p, 0.9 * straight.errors().l2p) << gap;
      EXPECT_LT(ours.errors().l2q, 0.9 * straight.errors().l2q) << gap;
      EXPECT_LT(ours.errors().npss, 0.9 * straight.errors().npss) << gap;
    }
}

TEST(Inbetween, JoinsBothSidesWithoutAJump) {
  const Clip& clip = new_walk();
  for (const InbetweenOptions& options : {without_feet(), InbetweenOptions{}}) {
    Clip whole = clip;
    const Clip gap = filled(clip, 150, 45, options);
    whole.translations.middleRows(150, 45) = gap.translations;
    whole.rotations.middleRows(150, 45) = gap.rotations;
    const FrameMatrix p = world_positions(whole), q = world_positions(clip);
    const auto largest_change = [](const FrameMatrix& x, Index first, Index count) {
      double largest = 0;
      for (Index t = first; t < first + count; ++t)
        largest = std::max(largest, (x.row(t + 1) - 2 * x.row(t) + x.row(t - 1)).cwiseAbs().maxCoeff());
      return largest;
    };
    const double usual = largest_change(q, 1, q.rows() - 2);
    EXPECT_LT(largest_change(p, 148, 4), 1.5 * usual);
    EXPECT_LT(largest_change(p, 193, 4), 1.5 * usual);
  }
}

TEST(Inbetween, AGapOfALearnedClipIsThatClip) {
  const Clip& clip = sample_clips()[1];
  const Clip gap = filled(clip, 200, 40, without_feet());
  const FrameMatrix made = world_positions(gap), truth = world_positions(slice(clip, 200, 40));
  EXPECT_LT((made - truth).cwiseAbs().maxCoeff(), 0.5);  // cm
}

TEST(Inbetween, TheWholeMovesWithItsEnds) {
  // Turned and moved as a whole, the gap is filled alike.
  const Clip& clip = new_walk();
  const Clip moved = stand_at(sample_model().features, clip, {300, -50, 2.5});
  const FrameMatrix here = world_positions(filled(clip, 100, 30, without_feet()));
  const Clip back = stand_at(sample_model().features, filled(moved, 100, 30, without_feet()),
                             root_place(sample_model().features, filled(clip, 100, 30, without_feet()), 0));
  EXPECT_LT((world_positions(back) - here).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Inbetween, WholeTurnsOfTheHeadingDoNotMatter) {
  // The same pose, its heading counted two turns on.
  const Clip& clip = new_walk();
  Clip after = slice(clip, 200, 60);
  const RootPlace place = root_place(sample_model().features, after, 0);
  after = stand_at(sample_model().features, after, {place.x, place.z, place.heading + 4 * std::numbers::pi});
  InbetweenReport report;
  const Clip gap = inbetween(sample_model(), slice(clip, 0, 160), after, 40, without_feet(), report);
  const Clip same = filled(clip, 160, 40, without_feet());
  EXPECT_LT((world_positions(gap) - world_positions(same)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Inbetween, SinglePosesAndAFreeEnd) {
  const Clip& clip = new_walk();
  InbetweenReport report;
  const Clip gap = inbetween(sample_model(), slice(clip, 100, 1), slice(clip, 131, 1), 30, without_feet(), report);
  EXPECT_EQ(gap.num_frames(), 30);
  const FrameMatrix made = world_positions(gap), truth = world_positions(slice(clip, 101, 30));
  EXPECT_LT((made - truth).cwiseAbs().mean(), 6);  // cm

  InbetweenOptions free = without_feet();
  free.place_end = false;
  const Clip far = stand_at(sample_model().features, slice(clip, 131, 100), {9000, 9000, 3});
  const Clip lead = inbetween(sample_model(), slice(clip, 0, 101), far, 30, free, report);
  const RootPlace wanted = root_place(sample_model().features, clip, 131);
  EXPECT_NEAR(report.end.x, wanted.x, 12);  // where a walk leads in half a second
  EXPECT_NEAR(report.end.z, wanted.z, 12);
  EXPECT_EQ(report.followed.size(), 1U);
}

TEST(GapExamples, WeightsSumToOneAndGiveTheirOwnPath) {
  const MotionTexture& model = sample_model();
  const GapExamples examples(model, {30, 10, 10, true});
  const Index row = model.runs[0].row + 100;
  const FrameMatrix before = model.corpus.middleRows(row - 9, 10).cast<double>();
  const FrameMatrix after = model.corpus.middleRows(row + 31, 10).cast<double>();
  RootPlace place;
  Clip clip = decode(model.features, model.corpus.middleRows(row, 32).cast<double>(), place);
  const RootStep step = root_step(model.features, place, root_place(model.features, clip, 31));
  const Vector seen = examples.seen(before, after, step);
  for (const double strength : {0.0, 0.5, 1.0}) EXPECT_NEAR(examples.weigh(seen, 5, strength).weights.sum(), 1, 1e-9);
  const auto own = examples.weigh(seen, 1, 1);
  EXPECT_EQ(examples.row(own.nearest[0]), row);
  EXPECT_NEAR(own.distance, 0, 1e-3);
  const FrameMatrix path = examples.mix(own.weights).features;
  EXPECT_LT((path - model.corpus.middleRows(row - 1, 34).cast<double>()).cwiseAbs().maxCoeff(), 0.05);
}

}  // namespace
}  // namespace motex
