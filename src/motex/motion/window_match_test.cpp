// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/window_match.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// A random walk that stays near 0.
FrameMatrixF wander(Rng& rng, Index frames, Index features) {
  FrameMatrixF series(frames, features);
  for (Index t = 0; t < frames; ++t)
    for (Index f = 0; f < features; ++f)
      series(t, f) = static_cast<float>((t > 0 ? 0.97 * series(t - 1, f) : 0) + 0.2 * rng.normal());
  return series;
}

/// The published definitions, one cut and one place at a time.
struct BruteForce {
  const FrameMatrixF &reference, &generated;
  std::vector<Index> runs;

  double cost(Index t, Index k) const { return (generated.row(t) - reference.row(k)).cast<double>().norm(); }
  double best_place(Index t, Index length) const {
    double best = kInf;
    Index first = 0;
    for (const Index run : runs) {
      for (Index k = first; k + length <= first + run; ++k) {
        double sum = 0;
        for (Index s = 0; s < length; ++s) sum += cost(t + s, k + s);
        best = std::min(best, sum);
      }
      first += run;
    }
    return best;
  }
  double cutting(Index window) const {
    std::vector<double> cheapest(static_cast<std::size_t>(generated.rows()) + 1, kInf);
    cheapest[0] = 0;
    for (Index end = window; end <= generated.rows(); ++end)
      for (Index begin = 0; begin + window <= end; ++begin) {
        double& now = cheapest[static_cast<std::size_t>(end)];
        const double before = cheapest[static_cast<std::size_t>(begin)];
        if (before < kInf) now = std::min(now, before + best_place(begin, end - begin));
      }
    return cheapest.back() / static_cast<double>(generated.rows());
  }
  double local(Index window) const {
    double sum = 0;
    const Index windows = generated.rows() - window + 1;
    for (Index t = 0; t < windows; ++t) sum += best_place(t, window);
    return sum / static_cast<double>(window * windows);
  }
};

TEST(MatchWindows, RefusesWhatHasNoWindow) {
  Rng rng(1);
  const FrameMatrixF a = wander(rng, 40, 3), b = wander(rng, 40, 3), narrow = wander(rng, 40, 2);
  const std::vector<Index> whole = {40}, halves = {20, 20}, wrong = {39};
  EXPECT_THROW(match_windows(a, halves, b), InvalidInput);
  EXPECT_THROW(match_windows(a, wrong, b), InvalidInput);
  EXPECT_THROW(match_windows(a, whole, narrow), InvalidInput);
  EXPECT_THROW(match_windows(a, whole, b.topRows(29)), InvalidInput);
  EXPECT_THROW(match_windows(a, {}, b), InvalidInput);
  std::atomic<bool> stop{true};
  JobContext job;
  job.cancel = &stop;
  EXPECT_THROW(match_windows(a, whole, b, {}, job), Cancelled);
}

TEST(MatchWindows, EqualsBruteForce) {
  Rng rng(2);
  for (const Index window : {4, 7}) {
    const FrameMatrixF reference = wander(rng, 60, 3), generated = wander(rng, 45, 3);
    const std::vector<Index> runs = {25, 3, 20, 12};
    const WindowMatchOptions options{window, 3, 1.0};
    const WindowMatchReport found = match_windows(reference, runs, generated, options);
    const BruteForce truth{reference, generated, runs};
    EXPECT_NEAR(found.global_diversity, truth.cutting(window), 1e-5);
    EXPECT_NEAR(found.local_diversity, truth.local(3), 1e-5);
    const std::vector<Index> whole = {45};
    const BruteForce other{generated, reference, whole};
    Index windows = 0, covered = 0, first = 0;
    for (const Index run : runs) {
      for (Index k = first; k + window <= first + run; ++k) {
        ++windows;
        covered += other.best_place(k, window) < options.threshold * static_cast<double>(window);
      }
      first += run;
    }
    EXPECT_EQ(found.num_reference_windows, windows);
    EXPECT_GT(covered, 0);
    EXPECT_LT(covered, windows);
    EXPECT_DOUBLE_EQ(found.coverage, static_cast<double>(covered) / static_cast<double>(windows));
  }
}

TEST(MatchWindows, AShuffledCopyCostsNothing) {
  Rng rng(3);
  const FrameMatrixF reference = wander(rng, 3000, 8);
  FrameMatrixF generated(200, 8);
  generated.topRows(90) = reference.middleRows(2500, 90);
  generated.middleRows(90, 40) = reference.middleRows(10, 40);
  generated.bottomRows(70) = reference.middleRows(1010, 70);
  const std::vector<Index> runs = {1000, 2000};
  const WindowMatchReport report = match_windows(reference, runs, generated);
  EXPECT_LT(report.global_diversity, 1e-6);
  EXPECT_LT(report.local_diversity, 0.5);
  EXPECT_GT(report.local_diversity, 0);
}

TEST(MatchWindows, IsTheSameForAnyNumberOfThreads) {
  Rng rng(4);
  const FrameMatrixF reference = wander(rng, 2500, 6), generated = wander(rng, 400, 6);
  const std::vector<Index> runs = {1200, 1300};
  JobContext one, three;
  one.jobs = 1, three.jobs = 3;
  const auto a = match_windows(reference, runs, generated, {}, one);
  const auto b = match_windows(reference, runs, generated, {}, three);
  EXPECT_EQ(a.coverage, b.coverage);
  EXPECT_EQ(a.global_diversity, b.global_diversity);
  EXPECT_EQ(a.local_diversity, b.local_diversity);
}

}  // namespace
}  // namespace motex
