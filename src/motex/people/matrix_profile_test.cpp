// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/matrix_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

FrameMatrix wandering(int num_frames, int num_signals, std::uint64_t seed) {
  Rng rng(seed);
  FrameMatrix x(num_frames, num_signals);
  for (Index s = 0; s < num_signals; ++s) {
    double level = 0;
    for (Index t = 0; t < num_frames; ++t) x(t, s) = 1000 + (level = 0.95 * level + rng.normal());
  }
  return x;
}

/// The definition, pair by pair.
void expect_exact(const SeriesWindows& windows, const MatrixProfile& profile) {
  for (int i = 0; i < windows.num_windows; ++i) {
    double best = std::numeric_limits<double>::infinity();
    for (int j = 0; j < windows.num_windows; ++j)
      if (std::abs(i - j) > profile.exclusion && windows.usable[static_cast<std::size_t>(i)] != 0 &&
          windows.usable[static_cast<std::size_t>(j)] != 0)
        best = std::min(best, windows.distance(i, j));
    const double found = profile.distance[static_cast<std::size_t>(i)];
    if (std::isinf(best))
      EXPECT_TRUE(std::isinf(found) && profile.nearest[static_cast<std::size_t>(i)] == -1) << i;
    else
      EXPECT_NEAR(found, best, 1e-7) << i;
  }
}

TEST(MatrixProfile, WindowsThatCannotBe) {
  EXPECT_THROW(series_windows(FrameMatrix::Random(50, 1), 3), InvalidInput);
  EXPECT_THROW(series_windows(FrameMatrix::Random(50, 1), 51), InvalidInput);
  EXPECT_THROW(series_windows(FrameMatrix::Random(50, 1), 10, {{45, 10}}), InvalidInput);
}

TEST(MatrixProfile, EqualsTheDefinition) {
  for (const int num_signals : {1, 3}) {
    const SeriesWindows windows = series_windows(wandering(400, num_signals, 7), 21);
    expect_exact(windows, matrix_profile(windows));
  }
}

/// From the series itself, without SeriesWindows: all signals of a window by one deviation.
double defined_distance(const FrameMatrix& x, int a, int b, int m) {
  const auto centred = [&](int start) {
    const Matrix window = x.middleRows(start, m);
    return Matrix(window.rowwise() - window.colwise().mean());
  };
  const Matrix first = centred(a), second = centred(b);
  return std::sqrt(static_cast<double>(m)) * (first / first.norm() - second / second.norm()).norm();
}

TEST(MatrixProfile, SeveralSignalsAreNormalisedByOneDeviation) {
  FrameMatrix x = wandering(300, 3, 12);
  x.col(1) *= 4;
  x.col(2) *= 0.01;  // hardly counts
  constexpr int kWindow = 16, kExclusion = 5;
  const MatrixProfile profile = matrix_profile(series_windows(x, kWindow), kExclusion);
  for (int i = 0; i + kWindow <= 300; ++i) {
    double best = std::numeric_limits<double>::infinity();
    for (int j = 0; j + kWindow <= 300; ++j)
      if (std::abs(i - j) > kExclusion) best = std::min(best, defined_distance(x, i, j, kWindow));
    EXPECT_NEAR(profile.distance[static_cast<std::size_t>(i)], best, 1e-7) << i;
  }
  FrameMatrix without = x;
  without.col(2).setZero();
  EXPECT_NEAR(series_windows(without, kWindow).distance(20, 90), series_windows(x, kWindow).distance(20, 90), 1e-3);
}

TEST(MatrixProfile, ShortSeriesOfFewWindows) {
  for (const int num_frames : {12, 15, 24, 40}) {
    const SeriesWindows windows = series_windows(wandering(num_frames, 1, 9), 12);
    expect_exact(windows, matrix_profile(windows));
  }
}

TEST(MatrixProfile, GapsConstantsAndStretches) {
  FrameMatrix x = wandering(500, 2, 8);
  x(100, 0) = std::nan("");
  x.block(200, 0, 60, 2).setConstant(3);
  x.block(300, 1, 60, 1).setConstant(-5);
  const SeriesWindows windows = series_windows(x, 20, {{0, 250}, {250, 200}});
  EXPECT_EQ(windows.usable[85], 0);
  EXPECT_EQ(windows.usable[210], 0);
  EXPECT_EQ(windows.usable[240], 0);
  EXPECT_EQ(windows.usable[310], 1);
  EXPECT_EQ(windows.usable[440], 0);
  expect_exact(windows, matrix_profile(windows));
}

TEST(MatrixProfile, ALargeOffsetAndBurstsDoNotSpoilSmallWindows) {
  FrameMatrix x = wandering(600, 1, 10);
  x.array() += 1e6;
  x.block(250, 0, 20, 1) *= 1.01;
  const SeriesWindows windows = series_windows(x, 30);
  expect_exact(windows, matrix_profile(windows));
}

TEST(MatrixProfile, TheSameForAnyNumberOfThreads) {
  const SeriesWindows windows = series_windows(wandering(6000, 1, 11), 40);
  JobContext one, three;
  one.jobs = 1;
  three.jobs = 3;
  const MatrixProfile a = matrix_profile(windows, -1, one), b = matrix_profile(windows, -1, three);
  EXPECT_EQ(a.distance, b.distance);
  EXPECT_EQ(a.nearest, b.nearest);
}

}  // namespace
}  // namespace motex
