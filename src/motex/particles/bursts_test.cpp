// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/bursts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/particles/simulate.h"

namespace motex {
namespace {

/// As a tracker would give them: places off by `error`, the first `late` or so frames missed, some sparks not found.
std::vector<Cable> as_tracked(std::vector<Cable> cables, double error, int late, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Cable> out;
  for (Cable& cable : cables) {
    const auto missed = static_cast<std::ptrdiff_t>(late > 0 ? 1 + rng.below(static_cast<std::uint64_t>(late)) : 0);
    if (rng.uniform() < 0.2 || cable.num_frames() < missed + 4) continue;
    cable.core.erase(cable.core.begin(), cable.core.begin() + missed);
    cable.poses.clear();
    cable.first_frame += missed;
    for (Base& base : cable.core) {
      base.x += error * rng.normal();
      base.y += error * rng.normal();
    }
    out.push_back(std::move(cable));
  }
  return out;
}

TEST(FindBursts, RejectsOptionsOutOfRange) {
  FindBurstsOptions options;
  options.min_cables = 1;
  EXPECT_THROW(find_bursts({}, options), InvalidInput);
}

TEST(FindBursts, AllOfAShowAreFoundWithPlaceAndTime) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    SimulateFireworksOptions options;
    options.width = 200;
    options.height = 150;
    options.frames = 110;
    options.seed = seed;
    const SimulatedScene scene = simulate_fireworks(options);
    const std::vector<Cable> cables = as_tracked(true_cables(scene), 0.3, 3, seed);
    const std::vector<Burst> bursts = find_bursts(cables);
    ASSERT_EQ(bursts.size(), scene.bursts.size());
    for (std::size_t i = 0; i < bursts.size(); ++i) {
      EXPECT_NEAR(bursts[i].frame, scene.bursts[i].frame, 1);
      EXPECT_LT(std::hypot(bursts[i].x - scene.bursts[i].x, bursts[i].y - scene.bursts[i].y), 1.5);
      EXPECT_GT(static_cast<double>(bursts[i].cables.size()), 0.6 * scene.bursts[i].num_sparks);
    }
  }
}

TEST(FindBursts, SnowHasNone) {
  SimulateSnowOptions options;
  options.width = 160;
  options.height = 120;
  options.frames = 60;
  options.elements = 150;
  EXPECT_TRUE(find_bursts(true_cables(simulate_snow(options))).empty());
}

/// Pieces of five frames that go any way: carried back their places are vague, so that many seem to meet.
TEST(FindBursts, ACrowdOfShortPathsHasNone) {
  Rng rng(3);
  std::vector<Cable> cables(1500);
  for (Cable& cable : cables) {
    cable.first_frame = static_cast<std::int64_t>(rng.below(26));
    const double x = rng.uniform(0, 320), y = rng.uniform(0, 240), vx = 2 * rng.normal(), vy = 2 * rng.normal();
    for (int t = 0; t < 5; ++t)
      cable.core.push_back({BaseKind::kGaussian, x + t * vx + rng.normal(), y + t * vy + rng.normal(), 1.5, 0, {}});
  }
  EXPECT_TRUE(find_bursts(cables).empty());
}

TEST(BurstStatistics, SayHowBurstsLook) {
  SimulateFireworksOptions options;
  options.width = 200;
  options.height = 150;
  options.frames = 110;
  const SimulatedScene scene = simulate_fireworks(options);
  const std::vector<Cable> cables = true_cables(scene);
  const std::vector<Burst> bursts = find_bursts(cables);
  const BurstStatistics statistics = burst_statistics(bursts, cables, options.frames);
  EXPECT_NEAR(statistics.num_cables.mean, 60, 12);
  EXPECT_NEAR(statistics.speed.mean, 2.2, 0.15);
  EXPECT_NEAR(statistics.speed.deviation, 0.5, 0.1);
  EXPECT_NEAR(statistics.life.mean, 39, 4);
  EXPECT_GT(statistics.angle_coverage, 0.9);
  EXPECT_EQ(burst_statistics({}, cables, 110).speed.mean, 0);
}

}  // namespace
}  // namespace motex
