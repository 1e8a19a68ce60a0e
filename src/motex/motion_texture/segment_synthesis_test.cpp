// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/segment_synthesis.h"

#include <gtest/gtest.h>

#include <limits>

#include "motex/core/error.h"
#include "motex/motion_texture/jumps.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

MotionTexture walking_model(Basis basis) {
  LearnOptions options;
  options.state_size = 6;
  options.basis = basis;
  LearnReport report;
  return learn_motion_texture(walking_clips(3, 400), options, report);
}

FrameMatrix rows(const MotionTexture& model, Index row, Index count) {
  return model.corpus.middleRows(row, count).cast<double>();
}

TEST(SegmentSynthesis, MeetsKeyPosesExactly) {
  for (const Basis basis : {Basis::kShared, Basis::kOwn}) {
    const MotionTexture model = walking_model(basis);
    const int n = static_cast<int>(model.instances.size());
    for (const NoiseSource source : {NoiseSource::kReplay, NoiseSource::kWhite}) {
      PlayOptions options;
      options.noise_source = source;
      SegmentSynthesis segments(model, options);
      for (int a = 0; a < n; ++a) {
        const int b = (7 * a + 3) % (n + 1) - 1;
        const Instance& from = model.instances[static_cast<std::size_t>(a)];
        const FrameMatrix& y = segments.play(a, b);
        const Index hand_over = hand_over_row(model, from);
        ASSERT_EQ(y.rows(), hand_over + 2 - from.row);
        EXPECT_TRUE(y.allFinite());
        EXPECT_EQ(y.topRows(2), rows(model, from.row, 2));
        EXPECT_EQ(y.bottomRows(2),
                  rows(model, b < 0 ? hand_over : model.instances[static_cast<std::size_t>(b)].row, 2));
      }
    }
  }
}

TEST(SegmentSynthesis, WithoutNoiseAnInstanceBeforeItsOwnSuccessorIsItself) {
  const MotionTexture model = walking_model(Basis::kShared);
  PlayOptions options;
  options.noise = 1e-9;
  SegmentSynthesis segments(model, options);
  for (int a = 0; a + 1 < static_cast<int>(model.instances.size()); ++a) {
    const auto i = static_cast<std::size_t>(a);
    const int next = model.instances[i + 1].run_idx == model.instances[i].run_idx ? a + 1 : -1;
    const FrameMatrix& y = segments.play(a, next);
    EXPECT_LT((y - rows(model, model.instances[i].row, y.rows())).cwiseAbs().maxCoeff(), 1e-5);
  }
}

TEST(SegmentSynthesis, MeetsPosesThatAreNotInTheCorpus) {
  for (const Basis basis : {Basis::kShared, Basis::kOwn}) {
    const MotionTexture model = walking_model(basis);
    const Instance& a = model.instances[1];
    const Piece piece{a.texton, a.row, a.length, a.row, a.row + a.length - 2, a.length + 9};
    FrameMatrix first = rows(model, a.row, 2), last = rows(model, a.row + a.length - 2, 2);
    for (const NoiseSource source : {NoiseSource::kReplay, NoiseSource::kWhite}) {
      PlayOptions options;
      options.noise_source = source;
      const FrameMatrix by_row = SegmentSynthesis(model, options).play(piece);
      EXPECT_EQ(SegmentSynthesis(model, options).play(piece, first, last), by_row);
      FrameMatrix bent_first = first, bent_last = last;
      bent_first.array() += 1.5;
      bent_last.array() -= 2;
      const FrameMatrix y = SegmentSynthesis(model, options).play(piece, bent_first, bent_last);
      EXPECT_EQ(y.topRows(2), bent_first);
      EXPECT_EQ(y.bottomRows(2), bent_last);
      EXPECT_TRUE(y.allFinite());
    }
    SegmentSynthesis segments(model, {});
    EXPECT_THROW(segments.play(piece, first.leftCols(3), last), InvalidInput);
    first(0, 0) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(segments.play(piece, first, last), InvalidInput);
  }
}

TEST(SegmentSynthesis, StepsAtTheEndsAreNoLargerThanElsewhere) {
  const MotionTexture model = walking_model(Basis::kShared);
  SegmentSynthesis segments(model, {});
  const int n = static_cast<int>(model.instances.size());
  for (int a = 0; a < n; ++a) {
    const FrameMatrix y = segments.play(a, (a + 5) % n);
    const FrameMatrix bends = y.bottomRows(y.rows() - 2) - 2 * y.middleRows(1, y.rows() - 2) + y.topRows(y.rows() - 2);
    const Vector sizes = bends.rowwise().norm();
    const double inside = sizes.segment(10, sizes.size() - 20).maxCoeff();
    EXPECT_LT(sizes.maxCoeff(), 2 * inside + 1) << "instance " << a;
  }
}

TEST(SegmentSynthesis, MoreNoiseStraysFarther) {
  const MotionTexture model = walking_model(Basis::kShared);
  double before = 0;
  for (const double noise : {1e-6, 0.2, 1.0, 3.0}) {
    PlayOptions options;
    options.noise = noise;
    SegmentSynthesis segments(model, options);
    const FrameMatrix& y = segments.play(0, 1);
    const double strayed = (y - rows(model, 0, y.rows())).norm();
    EXPECT_GT(strayed, before);
    before = strayed;
  }
}

TEST(SegmentSynthesis, SystemsThatGrowGiveFinitePathsOrAClearError) {
  for (const double factor : {1.2, 3.0, 1e100, 1e300}) {
    MotionTexture model = walking_model(Basis::kShared);
    for (Texton& texton : model.textons) texton.dynamics.transition *= factor;
    for (const NoiseSource source : {NoiseSource::kReplay, NoiseSource::kWhite}) {
      PlayOptions options;
      options.noise_source = source;
      SegmentSynthesis segments(model, options);
      try {
        EXPECT_TRUE(segments.play(0, 1).allFinite()) << "times " << factor;
      } catch (const NumericalFailure&) {
        EXPECT_GT(factor, 10);
      }
    }
  }
}

}  // namespace
}  // namespace motex
