// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/markov/segmentation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/markov/segmentation_oracles.h"

namespace motex {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// What a random segmentation problem looks like.
struct Shape {
  Index frames, states;
  double prior_count;
  SegmentOptions options;
  double impossible = 0;  // share of emissions that are −∞
  bool state_starts = false;
};

// Emissions follow a hidden label that changes now and then, so that the best path is not trivial.
struct Problem {
  FrameMatrixF emissions;
  std::vector<double> start;
  FrameMatrixF state_start;
  TransitionMatrix transitions;
  SegmentOptions options;

  Problem(const Shape& shape, std::uint64_t seed)
      : emissions(shape.frames, shape.states),
        transitions(static_cast<int>(shape.states), shape.prior_count),
        options(shape.options) {
    Rng rng(seed);
    Index label = 0;
    for (Index t = 0; t < shape.frames; ++t) {
      if (rng.uniform() < 0.02) label = static_cast<Index>(rng.below(static_cast<std::uint64_t>(shape.states)));
      for (Index i = 0; i < shape.states; ++i) {
        emissions(t, i) = static_cast<float>(-40 + 3 * rng.normal() + (i == label ? 1 : 0));
        if (rng.uniform() < shape.impossible) emissions(t, i) = -std::numeric_limits<float>::infinity();
      }
      start.push_back(-60 + 5 * rng.normal());
    }
    for (int k = 0; k < 3 * shape.states; ++k) {
      const auto n = static_cast<std::uint64_t>(shape.states);
      const int from = static_cast<int>(rng.below(n)), to = static_cast<int>(rng.below(n));
      transitions.add_count(from, to, rng.uniform(0.1, 3));
    }
    if (!shape.state_starts) return;
    state_start.resize(shape.frames, shape.states);
    for (float& init : state_start.reshaped())
      init = rng.uniform() < 0.2 ? -std::numeric_limits<float>::infinity() : static_cast<float>(10 * rng.normal());
  }
  SegmentationInput input() const { return {emissions, start, transitions, options, state_start}; }
};

void expect_close(double a, double b) {
  if (a == b) return;
  EXPECT_NEAR(a, b, 1e-9 * std::abs(b));
}

void expect_equal_to_brute_force(const Shape& shape, std::uint64_t seed) {
  SCOPED_TRACE(testing::Message() << "seed " << seed << ", states " << shape.states << ", T_min "
                                  << shape.options.min_length << ", T_max " << shape.options.max_length << ", s "
                                  << shape.options.num_start_frames << ", prior " << shape.prior_count);
  const Problem problem(shape, seed);
  const auto fast = segment_sequence(problem.input());
  const auto slow = segment_brute_force(problem.input());
  EXPECT_EQ(fast.is_feasible(), slow.is_feasible());
  expect_close(fast.score, slow.score);
  if (!fast.is_feasible()) return;
  expect_close(score_segmentation(problem.input(), fast.segments), fast.score);
  EXPECT_EQ(fast.segments, slow.segments);
}

TEST(Segmentation, RefusesWhatDoesNotFit) {
  const Problem good({50, 3, 1, {5, 20, 2}}, 1);
  Problem problem = good;
  problem.start.pop_back();
  EXPECT_THROW(segment_sequence(problem.input()), InvalidInput);
  problem = good;
  problem.transitions = TransitionMatrix(4);
  EXPECT_THROW(segment_sequence(problem.input()), InvalidInput);
  for (const SegmentOptions options : {SegmentOptions{0, 0, 0}, {5, 4, 0}, {5, 0, 6}, {5, 0, -1}}) {
    problem = good;
    problem.options = options;
    EXPECT_THROW(segment_sequence(problem.input()), InvalidInput);
  }
  problem = Problem({2, 3, 1, {5, 20, 2}}, 1);
  EXPECT_THROW(segment_sequence(problem.input()), InvalidInput);
}

TEST(Segmentation, NanAndPlusInfinityAreNumericalFailures) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    for (const Index frames : {4, 50}) {
      Problem problem({frames, 3, 1, {5, 20, 2}}, 1);
      problem.emissions(3, 1) = bad;
      EXPECT_THROW(segment_sequence(problem.input()), NumericalFailure);
    }
    Problem problem({50, 3, 1, {5, 20, 2}}, 1);
    problem.start[7] = static_cast<double>(bad);
    EXPECT_THROW(segment_sequence(problem.input()), NumericalFailure);
  }
}

TEST(Segmentation, EqualsBruteForceOn2000Frames) {
  std::uint64_t seed = 0;
  for (const Index states : {2, 7, 16}) {
    for (const double prior : {0.0, 1.0}) {
      for (const Index max_length : {0, 130}) {
        for (const Index num_start_frames : {0, 2}) {
          expect_equal_to_brute_force({2000, states, prior, {30, max_length, num_start_frames}}, ++seed);
        }
      }
    }
  }
}

TEST(Segmentation, EqualsBruteForceWithStartsThatDependOnTheState) {
  for (const Index max_length : {0, 130})
    for (const Index num_start_frames : {0, 2})
      expect_equal_to_brute_force({1000, 7, 1, {30, max_length, num_start_frames}, 0, true}, 9);
}

TEST(Segmentation, StartsOfStatesMustFit) {
  Problem problem({50, 3, 1, {5, 20, 2}, 0, true}, 1);
  problem.state_start(7, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(segment_sequence(problem.input()), NumericalFailure);
  problem.state_start.resize(50, 2);
  EXPECT_THROW(segment_sequence(problem.input()), InvalidInput);
}

TEST(Segmentation, EqualsBruteForceInManySmallProblems) {
  Rng rng(5);
  int num_infeasible = 0;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    const auto upto = [&](Index n) { return static_cast<Index>(rng.below(static_cast<std::uint64_t>(n))); };
    Shape shape{4 + upto(80), 1 + upto(10), rng.uniform() < 0.5 ? 0 : rng.uniform(0.01, 5), {}, 0};
    shape.options.min_length = 1 + upto(9);
    shape.options.num_start_frames = std::min<Index>(upto(4), shape.options.min_length);
    if (rng.uniform() < 0.6) shape.options.max_length = shape.options.min_length + upto(12);
    if (rng.uniform() < 0.5) shape.impossible = rng.uniform() < 0.5 ? 0.02 : 0.2;
    shape.state_starts = seed % 3 == 0;
    expect_equal_to_brute_force(shape, seed);
    const Problem problem(shape, seed);
    num_infeasible += segment_sequence(problem.input()).is_feasible() ? 0 : 1;
  }
  EXPECT_GT(num_infeasible, 50);
  EXPECT_LT(num_infeasible, 1000);
}

TEST(Segmentation, IsNeverBelowThePapersProgram) {
  int num_below = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Problem problem({400, 6, seed % 2 == 0 ? 0.0 : 1.0, {20, 0, 2}}, seed);
    const double exact = segment_sequence(problem.input()).score;
    const auto paper = segment_one_label(problem.input());
    expect_close(score_segmentation(problem.input(), paper.segments), paper.score);
    EXPECT_LE(paper.score, exact + 1e-9 * std::abs(exact));
    num_below += paper.score < exact - 1e-6 ? 1 : 0;
  }
  EXPECT_GT(num_below, 0);
}

TEST(Segmentation, ShortSequencesAreOneSegment) {
  const Problem problem({9, 4, 1, {20, 40, 2}}, 3);
  const auto report = segment_sequence(problem.input());
  ASSERT_EQ(report.segments.size(), 1U);
  EXPECT_EQ(report.segments[0].length, 9);
  expect_close(report.score, segment_brute_force(problem.input()).score);
  expect_close(score_segmentation(problem.input(), report.segments), report.score);
}

TEST(Segmentation, LengthsThatCannotAddUpAreInfeasible) {
  const Problem problem({90, 3, 1, {60, 70, 0}}, 3);
  const auto report = segment_sequence(problem.input());
  EXPECT_FALSE(report.is_feasible());
  EXPECT_EQ(report.score, -kInfinity);
}

TEST(Segmentation, EmptyStartDensityMeansZero) {
  Problem problem({200, 3, 1, {10, 0, 0}}, 4);
  std::fill(problem.start.begin(), problem.start.end(), 0);
  const auto with_zeros = segment_sequence(problem.input());
  problem.start.clear();
  const auto without = segment_sequence(problem.input());
  EXPECT_EQ(with_zeros.score, without.score);
  EXPECT_EQ(with_zeros.segments, without.segments);
}

TEST(Segmentation, ReadsRowsOfALargerTable) {
  const Problem problem({300, 5, 1, {10, 40, 2}}, 6);
  FrameMatrixF table = FrameMatrixF::Constant(320, 9, 1e6F);
  table.block(7, 2, 300, 5) = problem.emissions;
  const auto report =
      segment_sequence({table.block(7, 2, 300, 5), problem.start, problem.transitions, problem.options});
  EXPECT_EQ(report.segments, segment_sequence(problem.input()).segments);
}

TEST(ScoreSegmentation, RefusesSegmentsThatBreakTheRules) {
  const Problem problem({50, 3, 1, {10, 30, 2}}, 7);
  using Segments = std::vector<Segment>;
  EXPECT_NO_THROW(score_segmentation(problem.input(), Segments{{0, 0, 20}, {2, 20, 30}}));
  for (const auto& bad :
       {Segments{}, Segments{{0, 0, 20}}, Segments{{0, 0, 20}, {1, 21, 29}}, Segments{{0, 0, 5}, {1, 5, 45}},
        Segments{{0, 0, 20}, {3, 20, 30}}, Segments{{0, 0, 40}, {1, 40, 10}}, Segments{{0, 0, 30}, {1, 30, 30}}}) {
    EXPECT_THROW(score_segmentation(problem.input(), bad), InvalidInput);
  }
}

}  // namespace
}  // namespace motex
