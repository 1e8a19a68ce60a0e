// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/track_score.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/particles/best_pairs.h"

namespace motex {
namespace {

Track line(std::int64_t id, int first, int length, double x, double y) {
  Track track{id, {}};
  for (int t = 0; t < length; ++t) track.points.push_back({first + t, x + t, y, 0, 0, 1});
  return track;
}

TEST(TrackScore, RefusesWhatCannotBeScored) {
  EXPECT_THROW(score_tracks({}, {line(0, 0, 5, 0, 0)}), InvalidInput);
  EXPECT_THROW(score_tracks({line(0, 0, 5, 0, 0)}, {}, 0), InvalidInput);
  Track twice = line(0, 0, 3, 0, 0);
  twice.points[1].frame = 0;
  EXPECT_THROW(score_tracks({twice}, {}), InvalidInput);
}

TEST(TrackScore, TruthItselfIsPerfectAndNothingIsZero) {
  const std::vector<Track> truth{line(0, 0, 10, 5, 5), line(1, 3, 20, 50, 9), line(2, 0, 4, 5, 8)};
  const TrackingScore same = score_tracks(truth, truth);
  EXPECT_DOUBLE_EQ(same.alpha, 1);
  EXPECT_DOUBLE_EQ(same.beta, 1);
  EXPECT_DOUBLE_EQ(same.jsc, 1);
  EXPECT_DOUBLE_EQ(same.jsc_tracks, 1);
  EXPECT_DOUBLE_EQ(same.rmse, 0);
  const TrackingScore none = score_tracks(truth, {});
  EXPECT_DOUBLE_EQ(none.alpha, 0);
  EXPECT_DOUBLE_EQ(none.beta, 0);
  EXPECT_DOUBLE_EQ(none.jsc, 0);
}

TEST(TrackScore, HandCount) {
  // 10 true points; 6 of them met at distance 3 with gate 5, one frame more than the truth has, and a stray of 4.
  const TrackingScore score = score_tracks({line(0, 0, 10, 0, 0)}, {line(7, 4, 7, 4, 3), line(8, 0, 4, 100, 100)}, 5);
  EXPECT_NEAR(score.alpha, (6 * 2 - 5) / 50.0, 1e-12);
  EXPECT_NEAR(score.beta, (6 * 2 - 5) / (50.0 + 20), 1e-12);
  EXPECT_NEAR(score.jsc, 6.0 / (10 + 11 - 6), 1e-12);
  EXPECT_NEAR(score.jsc_tracks, 1.0 / 2, 1e-12);
  EXPECT_NEAR(score.rmse, 3, 1e-12);
}

TEST(TrackScore, WhatIsNotVisibleIsLeftOut) {
  Track track = line(0, 0, 10, -3, 5);
  track.points[6].amplitude = 0;
  const std::vector<Track> part = visible_part({track, line(1, 0, 4, 100, 100)}, 6, 20);
  ASSERT_EQ(part.size(), 1U);
  EXPECT_EQ(part[0].points.size(), 5U) << "x = 0 … 5 without the one of amplitude 0";
}

/// The best total over all ways to pair, by trying them.
double best_by_trying(const std::vector<std::vector<double>>& gains, std::size_t row, std::vector<bool>& used) {
  if (row == gains.size()) return 0;
  double best = best_by_trying(gains, row + 1, used);
  for (std::size_t column = 0; column < used.size(); ++column) {
    if (used[column] || gains[row][column] <= 0) continue;
    used[column] = true;
    best = std::max(best, gains[row][column] + best_by_trying(gains, row + 1, used));
    used[column] = false;
  }
  return best;
}

TEST(BestPairs, AsGoodAsTryingAllOfThem) {
  Rng rng(3);
  for (int trial = 0; trial < 300; ++trial) {
    const int num_rows = 1 + trial % 6, num_columns = 1 + trial / 7 % 6;
    std::vector<std::vector<double>> table(static_cast<std::size_t>(num_rows),
                                           std::vector<double>(static_cast<std::size_t>(num_columns)));
    std::vector<PairGain> gains;
    for (int i = 0; i < num_rows; ++i)
      for (int j = 0; j < num_columns; ++j)
        if (rng.uniform() < 0.6) {
          table[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = rng.uniform(-0.3, 1);
          gains.push_back({i, j, table[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]});
        }
    const std::vector<int> pairs = best_pairs(num_rows, num_columns, gains);
    double total = 0;
    std::vector<bool> taken(static_cast<std::size_t>(num_columns));
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (pairs[i] < 0) continue;
      ASSERT_FALSE(taken[static_cast<std::size_t>(pairs[i])]);
      taken[static_cast<std::size_t>(pairs[i])] = true;
      total += table[i][static_cast<std::size_t>(pairs[i])];
    }
    std::vector<bool> used(static_cast<std::size_t>(num_columns));
    ASSERT_NEAR(total, best_by_trying(table, 0, used), 1e-12) << "trial " << trial;
  }
}

}  // namespace
}  // namespace motex
