// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/random_projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/people/matrix_profile.h"
#include "motex/people/sax.h"

namespace motex {
namespace {

FrameMatrix with_repetitions(std::uint64_t seed) {
  Rng rng(seed);
  FrameMatrix x(1500, 1);
  for (Index t = 0; t < 1500; ++t) x(t, 0) = 0.3 * rng.normal();
  for (int k = 0; k < 4; ++k)
    for (int t = 0; t < 50; ++t) x(100 + 350 * k + t, 0) += 3 * std::sin(std::numbers::pi * t * t / 500.0);
  return x;
}

TEST(Sax, BreakpointsOfTheNormalDistribution) {
  const std::vector<double> four = sax_breakpoints(4);
  ASSERT_EQ(four.size(), 3U);
  EXPECT_NEAR(four[0], -0.6744897502, 1e-9);
  EXPECT_EQ(four[1], 0);
  EXPECT_NEAR(four[2], 0.6744897502, 1e-9);
  EXPECT_THROW(sax_breakpoints(1), InvalidInput);
}

TEST(Sax, SegmentsThatDoNotDivideTheWindowShareFrames) {
  const double x[] = {1, 2, 3, 4, 5};
  const std::vector<double> means = piecewise_means(x, 5, 2);
  EXPECT_NEAR(means[0], (1 + 2 + 0.5 * 3) / 2.5, 1e-15);
  EXPECT_NEAR(means[1], (0.5 * 3 + 4 + 5) / 2.5, 1e-15);
}

TEST(Sax, AMeanOnABreakpointBelongsAbove) {
  FrameMatrix x(4, 1);
  x << -1, 0, 0, 1;
  const SaxWords words = sax_words(series_windows(x, 4), 4, 4);
  EXPECT_EQ(words.letters, (std::vector<std::uint8_t>{0, 2, 2, 3}));
  EXPECT_THROW(sax_words(series_windows(x, 4), 5, 4), InvalidInput);
}

TEST(RandomProjection, FindsWhatTheExhaustiveSearchFinds) {
  const SeriesWindows windows = series_windows(with_repetitions(3), 50);
  RandomProjectionOptions options;
  options.radius = 0.45;
  const RandomProjectionReport report = random_projection_motifs(windows, options);
  const std::vector<Motif> exact = exhaustive_motifs(windows, options.radius, 1);
  ASSERT_FALSE(report.motifs.empty());
  ASSERT_EQ(exact.size(), 1U);
  ASSERT_EQ(exact[0].occurrences.size(), 4U);
  ASSERT_EQ(report.motifs[0].occurrences.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(report.motifs[0].occurrences[k].start, exact[0].occurrences[k].start, 30);
}

TEST(RandomProjection, TheMatrixHoldsAPairNextToTheClosest) {
  for (const std::uint64_t seed : {5U, 6U, 7U}) {
    const SeriesWindows windows = series_windows(with_repetitions(seed), 50);
    const MatrixProfile profile = matrix_profile(windows, 49);
    const double exact = *std::min_element(profile.distance.begin(), profile.distance.end()) / std::sqrt(50.0);
    const RandomProjectionReport report = random_projection_motifs(windows);
    EXPECT_LE(report.in_matrix.distance, 1.05 * exact);
    EXPECT_GE(report.in_matrix.distance, exact - 1e-9);
    EXPECT_LE(report.closest.distance, report.in_matrix.distance);
    EXPECT_GE(report.in_matrix.second - report.in_matrix.first, 50);
    EXPECT_LT(report.num_compared, 3000);
  }
}

TEST(RandomProjection, FewerLettersWhereLittleCollides) {
  const SeriesWindows few = series_windows(with_repetitions(3), 50);
  const SeriesWindows many = series_windows(with_repetitions(3).replicate(4, 1), 50);
  const RandomProjectionReport coarse = random_projection_motifs(few), fine = random_projection_motifs(many);
  EXPECT_LT(coarse.alphabet, 16);
  EXPECT_EQ(fine.alphabet, 16);
  RandomProjectionOptions options;
  options.alphabet = 16;
  EXPECT_EQ(random_projection_motifs(few, options).alphabet, 16);
}

TEST(RandomProjection, SaysWhyAWindowIsNoMotif) {
  RandomProjectionOptions options;
  options.radius = 0.45;
  options.max_motifs = 1;
  const RandomProjectionReport report = random_projection_motifs(series_windows(with_repetitions(3), 50), options);
  ASSERT_EQ(report.motifs.size(), 1U);
  ASSERT_FALSE(report.candidates.empty());
  for (const MotifCandidate& candidate : report.candidates) {
    ASSERT_FALSE(candidate.starts.empty());
    const bool alone = candidate.starts.size() == 1;
    EXPECT_EQ(candidate.reason.rfind("too few: ", 0) == 0, alone) << candidate.reason;
    const bool is_known = candidate.reason.find("2R") != std::string::npos ||
                          candidate.reason == "more than K = 1: those found occur at least as often";
    EXPECT_TRUE(alone || is_known) << candidate.reason;
  }
}

TEST(RandomProjection, TheSameSeedGivesTheSameMatrix) {
  const SeriesWindows windows = series_windows(with_repetitions(8), 50);
  const SaxWords words = sax_words(windows, 16, 8);
  const std::vector<CollisionMatrix> a = count_collisions(windows, words, 6, 8, 1);
  const std::vector<CollisionMatrix> b = count_collisions(windows, words, 6, 8, 1);
  ASSERT_EQ(a.size(), 3U);
  EXPECT_EQ(a[0].iteration, 2);
  EXPECT_EQ(a[2].iteration, 8);
  ASSERT_EQ(a[2].cells.size(), b[2].cells.size());
  for (std::size_t k = 0; k < a[2].cells.size(); ++k) EXPECT_EQ(a[2].cells[k].count, b[2].cells[k].count);
}

TEST(RandomProjection, TrivialMatchesDoNotCollide) {
  const SeriesWindows windows = series_windows(with_repetitions(4), 50);
  const RandomProjectionReport report = random_projection_motifs(windows);
  ASSERT_EQ(report.collisions.size(), 3U);
  EXPECT_LT(report.collisions[0].cells.size(), report.collisions[2].cells.size());
  for (const Collision& collision : report.collisions[2].cells) EXPECT_GE(collision.column - collision.row, 50);
}

}  // namespace
}  // namespace motex
