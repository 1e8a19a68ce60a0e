// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/texton_revisits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "motex/core/rng.h"

namespace motex {
namespace {

RevisitSource swinging(Index rows, double period) {
  RevisitSource source;
  source.rows.resize(rows, 2);
  for (Index t = 0; t < rows; ++t) {
    const double phase = 2 * M_PI * static_cast<double>(t) / period;
    source.rows.row(t) << 20 * std::cos(phase), 20 * std::sin(phase);
  }
  source.speeds = Vector::Ones(rows);
  source.starts = {0};
  return source;
}

RevisitSource random_source(Index rows, std::vector<Index> starts) {
  RevisitSource source;
  Rng rng(3);
  source.rows.resize(rows, 3);
  source.speeds.resize(rows);
  for (Index t = 0; t < rows; ++t) {
    for (Index c = 0; c < 3; ++c) source.rows(t, c) = 10 * rng.normal();
    source.speeds[t] = 1 + rng.uniform();
  }
  source.starts = std::move(starts);
  return source;
}

TEST(RevisitPlanner, GoesRoundOnceMore) {
  const RevisitPlanner planner(swinging(130, 40), 20, 1.0 / 60, 168);
  const auto ways = planner.ways(168, 168, 0);
  ASSERT_EQ(ways.size(), 1U);
  ASSERT_EQ(ways[0].visits.size(), 2U);
  EXPECT_EQ(ways[0].visits[0].last - ways[0].visits[1].first, 40);
  EXPECT_LT(ways[0].largest_cut, 1e-6);
  EXPECT_NEAR(ways[0].cost, 0.5, 1e-9);
}

TEST(RevisitPlanner, LeavesOneRoundOut) {
  const auto ways = RevisitPlanner(swinging(130, 40), 20, 1.0 / 60, 88).ways(80, 96, 0);
  const auto exact = std::find_if(ways.begin(), ways.end(), [](const auto& way) { return way.num_steps == 88; });
  ASSERT_NE(exact, ways.end());
  EXPECT_LT(exact->largest_cut, 1e-6);
  for (const auto& way : ways) EXPECT_GE(way.cost + 1e-9, exact->cost);
}

TEST(RevisitPlanner, EveryWayIsOneWayFromTheFirstPairToTheLast) {
  const RevisitSource source = random_source(70, {0, 40});
  for (const auto& way : RevisitPlanner(source, 10, 1.0 / 60, 50).ways(1, 120, -0.2)) {
    Index steps = 0;
    double sum = 0;
    EXPECT_EQ(way.visits.front().first, 0);
    EXPECT_EQ(way.visits.back().last, 38);
    for (const Visit& visit : way.visits) {
      ASSERT_LT(visit.first, visit.last);
      EXPECT_EQ(visit.first < 40, visit.last < 39) << "a visit crosses from one example into the next";
      EXPECT_LT(visit.last, 69);
      steps += visit.last - visit.first;
      sum += source.speeds.segment(visit.first, visit.last - visit.first).sum();
    }
    EXPECT_EQ(steps, way.num_steps);
    EXPECT_NEAR(way.speed, sum / static_cast<double>(steps) / source.speeds.head(38).mean(), 1e-12);
  }
}

/// All ways by trying them: cost with λ s of the cheapest that plays from `row` on in so many steps.
double cheapest(const std::function<double(Index, Index)>& cut, const Vector& favour, Index row, Index least,
                Index last, Index steps) {
  double best = steps == last - row && steps >= least ? favour.segment(row, steps).sum() : HUGE_VAL;
  for (Index a = row + least; a <= last && a - row < steps; ++a)
    for (Index b = 0; b + least <= last; ++b)
      if (std::abs(a - b) >= 2)
        best = std::min(best, favour.segment(row, a - row).sum() + cut(a, b) +
                                  cheapest(cut, favour, b, least, last, steps - (a - row)));
  return best;
}

TEST(RevisitPlanner, NoWayIsCheaper) {
  constexpr Index kLast = 10, kLeast = 3;
  const RevisitSource source = random_source(kLast + 2, {0});
  constexpr double kTau = 15, kLambda = 0.3, kFrameTime = 0.1;  // δ looks 2 frames around
  const auto cut = [&](Index a, Index b) {
    double sum = 0, count = 0;
    const Index rows = source.rows.rows();
    for (Index k = -std::min({Index{2}, a, b}); k <= std::min({Index{2}, rows - 1 - a, rows - 1 - b}); ++k, ++count)
      sum += (source.rows.row(a + k) - source.rows.row(b + k)).squaredNorm();
    return 0.5 + sum / count / (kTau * kTau);
  };
  const Vector favour = kLambda * (source.speeds / source.speeds.head(kLast).mean() - Vector::Ones(kLast + 2));
  const RevisitPlanner planner(source, kTau, kFrameTime, kLast);
  std::map<Index, double> found;
  for (const auto& way : planner.ways(1, 16, kLambda)) {
    double cost = way.cost;
    for (const Visit& visit : way.visits) cost += favour.segment(visit.first, visit.last - visit.first).sum();
    found[way.num_steps] = cost;
  }
  for (Index steps = 1; steps <= 16; ++steps) {
    const double truth = cheapest(cut, favour, 0, kLeast, kLast, steps);
    ASSERT_EQ(found.count(steps) == 1, truth < HUGE_VAL) << steps;
    if (truth < HUGE_VAL) {
      EXPECT_NEAR(found[steps], truth, 1e-9) << steps;
    }
  }
}

TEST(RevisitPlanner, FavoursQuickParts) {
  RevisitSource source = swinging(130, 40);
  for (Index t = 0; t < 130; ++t) source.speeds[t] = t < 65 ? 1 : 2;
  const RevisitPlanner planner(source, 20, 1.0 / 60, 168);
  EXPECT_GT(planner.ways(168, 168, -0.2).at(0).speed, 1.05);
  EXPECT_LT(planner.ways(168, 168, 0.2).at(0).speed, 0.95);
}

}  // namespace
}  // namespace motex
