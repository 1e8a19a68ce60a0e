// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motex/core/rng.h"
#include "motex/particles/depth.h"
#include "motex/particles/forks.h"
#include "motex/particles/interaction.h"

namespace motex {
namespace {

Base blob(double x, double y, double scale, double peak) {
  Base base{BaseKind::kGaussian, x, y, scale, 0, {}};
  base.coefficients[0] = static_cast<float>(coefficient_of_peak(base, peak));
  return base;
}

/// A wide bar of light that becomes two blobs in frame 6; `backwards`: two that become one.
std::vector<Cable> splitting(bool backwards) {
  Cable one{0, {}, {}, -1, {}}, left{6, {}, {}, -1, {}}, right = left, stranger = left;
  for (int t = 0; t < 6; ++t) one.core.push_back(blob(30, 10 + 3 * t, 2.2, 60));
  for (int t = 6; t < 12; ++t) {
    left.core.push_back(blob(28.5 - 0.5 * (t - 6), 10 + 3 * t, 1.8, 45));
    right.core.push_back(blob(31.5 + 0.5 * (t - 6), 10 + 3 * t, 1.8, 45));
    stranger.core.push_back(blob(70, 40, 1.8, 45));
  }
  std::vector<Cable> cables{one, left, stranger, right};
  if (!backwards) return cables;
  for (Cable& cable : cables) {
    std::reverse(cable.core.begin(), cable.core.end());
    cable.first_frame = 12 - cable.end_frame();
  }
  return cables;
}

TEST(Forks, OneThatBecomesTwoIsFoundInBothDirectionsOfTime) {
  const ForksReport forth = find_forks(splitting(false), 12, 96, 64);
  ASSERT_EQ(forth.forks.size(), 1U);
  EXPECT_TRUE(forth.merges.empty());
  EXPECT_EQ(forth.forks[0].one, 0);
  EXPECT_EQ(forth.forks[0].two, (std::array<int, 2>{1, 3}));
  EXPECT_EQ(forth.forks[0].frame, 5);
  const ForksReport back = find_forks(splitting(true), 12, 96, 64);
  ASSERT_EQ(back.merges.size(), 1U);
  EXPECT_TRUE(back.forks.empty());
  EXPECT_EQ(back.merges[0].frame, 6);
}

TEST(Forks, OneThatGoesOnAsOneIsNoFork) {
  std::vector<Cable> cables = splitting(false);
  cables.pop_back();
  cables[1].core[0] = blob(30, 28, 2.2, 60);
  EXPECT_TRUE(find_forks(cables, 12, 96, 64).forks.empty());
}

/// Cables with velocities that follow themselves and, by `coupling`, their neighbours.
std::vector<Cable> flock(double coupling) {
  constexpr int kNum = 60, kFrames = 60;
  Rng rng(3);
  std::vector<Cable> cables(kNum);
  std::vector<double> vx(kNum), vy(kNum);
  for (Cable& cable : cables) cable.core.push_back(blob(rng.uniform(0, 60), rng.uniform(0, 60), 1, 50));
  for (int t = 1; t < kFrames; ++t) {
    const std::vector<double> old_x = vx, old_y = vy;
    for (std::size_t i = 0; i < kNum; ++i) {
      double w = 1e-12, nx = 0, ny = 0;
      const Base& me = cables[i].core.back();
      for (std::size_t j = 0; j < kNum; ++j) {
        const Base& other = cables[j].core[static_cast<std::size_t>(t - 1)];
        const double d = std::hypot(other.x - me.x, other.y - me.y);
        if (j == i || d > 24) continue;
        const double e = std::exp(-d * d / 128);
        w += e, nx += e * old_x[j], ny += e * old_y[j];
      }
      vx[i] = 0.5 * old_x[i] + coupling * nx / w + 0.2 * rng.normal();
      vy[i] = 0.5 * old_y[i] + coupling * ny / w + 0.2 * rng.normal();
    }
    for (std::size_t i = 0; i < kNum; ++i) {
      const Base& last = cables[i].core.back();
      cables[i].core.push_back(blob(last.x + vx[i], last.y + vy[i], 1, 50));
    }
  }
  return cables;
}

TEST(Interaction, FindsWhatNeighboursDoToOneAnotherAndNothingWhereTheyDoNot) {
  const Interaction with = measure_interaction(flock(0.4), 60, {}, 8),
                    without = measure_interaction(flock(0), 60, {}, 8);
  EXPECT_NEAR(with.coupling, 0.4, 0.08);
  EXPECT_NEAR(with.persistence, 0.5, 0.06);
  EXPECT_GT(with.explained_with, with.explained_alone + 0.01);
  EXPECT_LT(std::abs(without.coupling), 4 * without.coupling_error);
  EXPECT_LT(std::abs(without.explained_with - without.explained_alone), 0.01);
  EXPECT_EQ(measure_interaction({}, 10, {}, 8).num_steps, 0);
}

TEST(Depth, NearFlakesAreLargeAndFast) {
  Rng rng(5);
  std::vector<Cable> parallax, none;
  std::vector<double> truth;
  for (int k = 0; k < 150; ++k) {
    truth.push_back(std::exp(0.4 * rng.normal()));
    const double size = 2 / truth.back() * std::exp(0.1 * rng.normal()),
                 speed = 4 / truth.back() * std::exp(0.1 * rng.normal());
    Cable cable{0, {}, {}, -1, {}}, other = cable;
    const double any = 4 * std::exp(0.4 * rng.normal());
    for (int t = 0; t < 8; ++t) {
      cable.core.push_back(blob(50, speed * t, size, 50));
      other.core.push_back(blob(50, any * t, size, 50));
    }
    parallax.push_back(cable);
    none.push_back(other);
  }
  const DepthReport report = estimate_depth(parallax);
  EXPECT_TRUE(report.reliable);
  EXPECT_NEAR(report.slope, 1, 0.15);
  for (std::size_t k = 0; k < truth.size(); ++k) EXPECT_NEAR(std::log(report.depths[k] / truth[k]), 0, 0.35);
  EXPECT_FALSE(estimate_depth(none).reliable);
  EXPECT_FALSE(estimate_depth({}).reliable);
}

}  // namespace
}  // namespace motex
