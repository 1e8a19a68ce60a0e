// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/move_path.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "motex/core/rng.h"
#include "motex/motion_texture/initial_segments.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

constexpr Index kLength = 40;

/// Moves of kLength frames one after another, each a path of its own through three dimensions, with noise.
struct Moves {
  FrameMatrix states;
  std::vector<Run> runs;
  Segmentation segments;
};

Moves moves(int num_moves, int repeats, std::uint64_t seed) {
  Rng rng(seed);
  Moves out;
  const Index frames = Index{num_moves} * repeats * kLength;
  out.states.resize(frames, 3);
  out.runs = {{0, 0, 0, frames}};
  for (Index k = 0; k < Index{num_moves} * repeats; ++k) {
    const auto move = static_cast<int>(rng.below(static_cast<std::uint64_t>(num_moves)));
    out.segments.push_back({move, 0, k * kLength, kLength});
    for (Index t = 0; t < kLength; ++t) {
      const double phase = 2 * std::numbers::pi * static_cast<double>(t) / kLength;
      for (Index j = 0; j < 3; ++j)
        out.states(k * kLength + t, j) =
            20 * std::sin(phase * (1 + (move + j) % 3) + 1.3 * move + static_cast<double>(j)) + rng.normal();
    }
  }
  return out;
}

PathStatistics sum(const MovePaths& paths, const Segmentation& segments, int texton) {
  PathStatistics out = paths.nothing();
  for (const LabelledSegment& segment : segments)
    if (segment.texton == texton) out += paths.observe(segment.row);
  return out;
}

TEST(MovePaths, WindowsEndWithTheirRun) {
  const Moves truth = moves(3, 4, 1);
  const std::vector<motex::Run> runs{{0, 0, 0, 100}, {0, 100, 100, 30}};
  const MovePaths paths(truth.states, runs, kLength, 1);
  EXPECT_EQ(paths.size(), 3 * MovePaths::kPoints);
  const std::vector<bool>& whole = paths.windows().is_whole;
  EXPECT_TRUE(whole[60]);
  EXPECT_FALSE(whole[90]) << "would look into the next run";
  EXPECT_FALSE(whole[100]) << "a run shorter than a window";
  EXPECT_EQ(paths.observe(90).count, 0);
  EXPECT_TRUE(paths.windows().values.row(90).isZero());
}

TEST(MovePaths, DirectionsThatHardlyMoveAreNotLookedAt) {
  Moves truth = moves(3, 10, 2);
  truth.states.col(1) *= 1e-3;
  EXPECT_EQ(MovePaths(truth.states, truth.runs, kLength, 1).size(), 2 * MovePaths::kPoints);
  truth.states.setConstant(4);
  EXPECT_EQ(MovePaths(truth.states, truth.runs, kLength, 1).size(), 0) << "nothing moves";
}

/// Diagonal of R as the header defines it.
Vector variance_ratio(const MovePaths& paths, const FrameMatrix& states) {
  const Vector mean = states.colwise().mean().transpose();
  const Vector variance =
      (states.rowwise() - mean.transpose()).colwise().squaredNorm().transpose() / static_cast<double>(states.rows());
  const Index first = kLength / MovePaths::kPoints / 2;
  const double scale = static_cast<double>(paths.windows().values(0, 0)) / (states(first, 0) - mean(0));
  return (variance * scale * scale).replicate(MovePaths::kPoints, 1);
}

TEST(MovePaths, MergingGainsTheBayesFactorOfOnePathAgainstTwo) {
  const Moves truth = moves(2, 6, 3);
  const MovePaths paths(truth.states, truth.runs, kLength, 1.7);
  const Vector r = variance_ratio(paths, truth.states);
  for (const Index row : {Index{1}, kLength, 3 * kLength}) {
    const PathStatistics a = paths.observe(0), b = paths.observe(row);
    double expected = 0;  // both windows under one path are a Gaussian of covariance [1 + r, r; r, 1 + r]
    for (Index j = 0; j < r.size(); ++j) {
      const double x = a.sum(j), y = b.sum(j), v = 1 + r(j), det = v * v - r(j) * r(j);
      expected -= 0.5 * (std::log(det) + (v * x * x - 2 * r(j) * x * y + v * y * y) / det);
      expected += 0.5 * (2 * std::log(v) + (x * x + y * y) / v);
    }
    EXPECT_NEAR(paths.evidence(a, b) - paths.evidence(a) - paths.evidence(b), 1.7 * expected,
                1e-4 * std::abs(expected) + 1e-4);
    PathStatistics both = a;
    both += b;
    EXPECT_DOUBLE_EQ(paths.evidence(both), paths.evidence(a, b));
  }
}

TEST(MovePaths, NoOtherPathExplainsAGroupBetter) {
  const Moves truth = moves(2, 6, 3);
  const MovePaths paths(truth.states, truth.runs, kLength, 1.7);
  const Vector best = paths.path(paths.observe(0));
  const auto explains = [&](const Vector& path) {
    return static_cast<double>(paths.start_densities(paths.windows(), {path}, {})(0, 0)) + paths.log_prior(path);
  };
  Rng rng(4);
  for (int k = 0; k < 20; ++k) {
    Vector other = best;
    for (double& x : other) x += 0.05 * rng.normal();
    EXPECT_GT(explains(best), explains(other));
  }
}

TEST(MovePaths, StartDensitiesCompareTheWindowWithABlindOne) {
  const Moves truth = moves(3, 8, 5);
  const MovePaths paths(truth.states, truth.runs, kLength, 2);
  std::vector<Vector> all;
  for (int i = 0; i < 3; ++i) all.push_back(paths.path(sum(paths, truth.segments, i)));
  const FrameMatrixF starts = paths.start_densities(paths.windows(), all, {});
  for (const LabelledSegment& segment : truth.segments) {
    if (!paths.windows().is_whole[static_cast<std::size_t>(segment.row)]) continue;
    Index best = 0;
    EXPECT_GT(starts.row(segment.row).maxCoeff(&best), 0) << "better than blind";
    EXPECT_EQ(best, segment.texton);
  }
  EXPECT_TRUE(starts.bottomRows(20).isZero()) << "no whole window, no opinion";
  const FrameMatrixF twice = MovePaths(truth.states, truth.runs, kLength, 4).start_densities(paths.windows(), all, {});
  EXPECT_TRUE(twice.isApprox(2 * starts, 1e-5F));
}

TEST(MergedMoves, FindTheMovesAndStopBySelf) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Moves truth = moves(4, 10, seed);
    Corpus corpus;
    corpus.runs = truth.runs;
    const MovePaths paths(truth.states, truth.runs, kLength, 1);
    // One piece a texton needs no merge at all: the Bayes factor alone has to find the four.
    const Segmentation found = merged_moves(corpus, paths, 1, kLength, {});
    ASSERT_EQ(found.size(), truth.segments.size());
    EXPECT_GT(label_agreement(found, truth.segments, 1), 0.99) << "seed " << seed;
    int textons = 0;
    for (const LabelledSegment& s : found) textons = std::max(textons, s.texton + 1);
    EXPECT_LE(textons, 5);
  }
}

TEST(MergedMoves, GoOnToAsManyPiecesATextonAsAreWanted) {
  const Moves truth = moves(8, 5, 7);
  Corpus corpus;
  corpus.runs = truth.runs;
  const MovePaths paths(truth.states, truth.runs, kLength, 1);
  JobContext one, two;
  one.jobs = 1, two.jobs = 2;
  const Segmentation found = merged_moves(corpus, paths, 20, kLength, one);
  int textons = 0;
  for (const LabelledSegment& s : found) textons = std::max(textons, s.texton + 1);
  EXPECT_EQ(textons, 2);
  const Segmentation again = merged_moves(corpus, paths, 20, kLength, two);
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k].texton, again[k].texton);
  const std::atomic<bool> cancel{true};
  one.cancel = &cancel;
  EXPECT_THROW(merged_moves(corpus, paths, 20, kLength, one), Cancelled);
}

}  // namespace
}  // namespace motex
