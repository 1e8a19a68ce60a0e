// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/birth_death.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/particles/parzen.h"
#include "motex/particles/simulate.h"

namespace motex {
namespace {

Cable straight_cable(std::int64_t first_frame, int num_frames, double x, double y, double vx, double vy) {
  Cable cable;
  cable.first_frame = first_frame;
  for (int t = 0; t < num_frames; ++t) {
    Base base;
    base.kind = BaseKind::kGaussian;
    base.x = x + vx * t;
    base.y = y + vy * t;
    base.scale = 1.2;
    base.coefficients[0] = 200;
    cable.core.push_back(base);
  }
  return cable;
}

double sum_of(const Plane& plane) { return std::accumulate(plane.values.begin(), plane.values.end(), 0.0); }

SimulateSnowOptions small_snow() {
  SimulateSnowOptions options;
  options.width = 160;
  options.height = 120;
  options.frames = 60;
  options.elements = 40;
  return options;
}

/// Some of the cables lose a few frames in the middle and go on under another number.
std::vector<Cable> broken(const std::vector<Cable>& cables, double share, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Cable> out;
  for (const Cable& cable : cables) {
    const auto length = static_cast<std::size_t>(cable.num_frames());
    if (length < 12 || rng.uniform() >= share) {
      out.push_back(cable);
      continue;
    }
    const std::size_t at = 4 + static_cast<std::size_t>(rng.below(length - 11)), gap = 1 + rng.below(3);
    Cable head = cable, tail = cable;
    head.core.resize(at);
    tail.core.erase(tail.core.begin(), tail.core.begin() + static_cast<std::ptrdiff_t>(at + gap));
    tail.first_frame += static_cast<std::int64_t>(at + gap);
    head.poses.clear();
    tail.poses.clear();
    out.push_back(std::move(head));
    out.push_back(std::move(tail));
  }
  return out;
}

TEST(BirthDeathMaps, RejectsWhatHasNoSize) {
  EXPECT_THROW(estimate_maps({}, 0, 10, 5), InvalidInput);
  EXPECT_THROW(estimate_maps({}, 10, 10, 0), InvalidInput);
  MapOptions options;
  options.bandwidth = -1;
  EXPECT_THROW(estimate_maps({}, 10, 10, 5, options), InvalidInput);
}

TEST(BirthDeathMaps, WithoutCablesAllIsZero) {
  const BirthDeathMaps maps = estimate_maps({}, 20, 10, 5);
  EXPECT_EQ(maps.births_per_frame, 0);
  EXPECT_EQ(sum_of(maps.source), 0);
  EXPECT_EQ(sum_of(maps.hazard), 0);
  EXPECT_EQ(maps.occupancy.width, 20);
}

TEST(BirthDeathMaps, FirstAndLastFrameAreCensored) {
  const std::vector<Cable> cables{straight_cable(0, 10, 5, 5, 1, 0), straight_cable(3, 7, 5, 15, 1, 0),
                                  straight_cable(2, 4, 30, 10, 0, 1), straight_cable(0, 4, 30, 30, 0.5, 0)};
  const BirthDeathMaps maps = estimate_maps(cables, 40, 40, 10);
  ASSERT_EQ(maps.births.size(), 2U);
  ASSERT_EQ(maps.deaths.size(), 2U);
  EXPECT_EQ(maps.births[0].frame, 3);
  EXPECT_EQ(maps.births[1].cable, 2);
  EXPECT_EQ(maps.deaths[0].frame, 5);
  EXPECT_DOUBLE_EQ(maps.deaths[0].y, 13);
  EXPECT_DOUBLE_EQ(maps.deaths[0].vy, 1);
  EXPECT_DOUBLE_EQ(maps.births_per_frame, 2.0 / 9);
  EXPECT_NEAR(sum_of(maps.source), 1, 1e-4);
  EXPECT_NEAR(sum_of(maps.sink), 1, 1e-4);
  EXPECT_NEAR(sum_of(maps.occupancy), (10 + 7 + 4 + 4) / 10.0, 1e-3);
}

TEST(BirthDeathMaps, TheWindowIsNotDarkAtTheBorder) {
  Plane even(60, 50, 1);
  for (const double bandwidth : {1.0, 3.0, 8.0}) {
    const Plane smooth = parzen_smooth(even, bandwidth);
    EXPECT_NEAR(sum_of(smooth), 3000, 1);
    EXPECT_NEAR(static_cast<double>(smooth.at(0, 25)), 1, 1e-5);
    EXPECT_NEAR(static_cast<double>(smooth.at(30, 49)), 1, 1e-5);
  }
  Plane corner(7, 5);
  corner.at(0, 4) = 3;
  EXPECT_NEAR(sum_of(parzen_smooth(corner, 4)), 3, 1e-5);  // wider than the picture
}

TEST(BirthDeathMaps, HazardTimesOccupancyAreTheDeaths) {
  const SimulatedScene scene = simulate_snow(small_snow());
  const BirthDeathMaps maps = estimate_maps(true_cables(scene), 160, 120, 60);
  double dying = 0;
  for (std::size_t i = 0; i < maps.hazard.values.size(); ++i)
    dying += static_cast<double>(maps.hazard.values[i]) * static_cast<double>(maps.occupancy.values[i]);
  const double deaths = static_cast<double>(maps.deaths.size()) / 59;
  EXPECT_NEAR(dying, deaths, 0.05 * deaths);
}

TEST(BirthDeathMaps, BandwidthGrowsWithTheSpreadOfThePoints) {
  const auto chosen = [](double spread) {
    Rng rng(5);
    PointCounts counts(200, 160);
    for (int i = 0; i < 400; ++i) counts.add(100 + spread * rng.normal(), 80 + spread * rng.normal());
    return choose_bandwidth({&counts});
  };
  EXPECT_LT(chosen(2), chosen(8));
  EXPECT_LT(chosen(8), chosen(25));
}

TEST(BirthDeathMaps, SnowIsBornUpwindAndDiesDownwind) {
  const SimulatedScene scene = simulate_snow(small_snow());
  const BirthDeathMaps maps = estimate_maps(true_cables(scene), 160, 120, 60);
  double upwind_births = 0, downwind_deaths = 0;  // it goes to the left and down
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      if (x > 150 || y < 10) upwind_births += static_cast<double>(maps.source.at(x, y));
      if (x < 10 || y > 110) downwind_deaths += static_cast<double>(maps.sink.at(x, y));
    }
  }
  EXPECT_GT(upwind_births, 0.95);
  EXPECT_GT(downwind_deaths, 0.95);
  EXPECT_GT(maps.hazard.at(80, 119), 0.15F);
  EXPECT_LT(maps.hazard.at(80, 60), 0.02F);
  EXPECT_LT(vanishing_hazard(maps, true_cables(scene), 60).at(80, 119), 0.1F);
  EXPECT_TRUE(maps.bursts.empty());
  // flux through two sides: 40 / (160 · 120) a pixel, (3 · 160 + 2 · 120) pixels a frame
  EXPECT_NEAR(maps.births_per_frame, 40.0 * (3 * 160 + 2 * 120) / (160 * 120), 0.35);
}

/// Of two that come near, the later one is not seen while they are.
std::vector<Cable> crossing(const std::vector<Cable>& cables, double near, double width, double height) {
  std::vector<Cable> out;
  for (std::size_t i = 0; i < cables.size(); ++i) {
    Cable piece;
    for (std::int64_t t = cables[i].first_frame; t < cables[i].end_frame(); ++t) {
      const Base& base = cables[i].at(t);
      bool hidden = false;
      for (std::size_t j = 0; j < i && !hidden; ++j)
        hidden = cables[j].covers(t) && std::hypot(cables[j].at(t).x - base.x, cables[j].at(t).y - base.y) < near;
      const bool at_border = base.x < 8 || base.y < 8 || base.x > width - 8 || base.y > height - 8;
      if (hidden && !at_border) {
        if (!piece.core.empty()) out.push_back(piece);
        piece = {};
        continue;
      }
      if (piece.core.empty()) piece.first_frame = t;
      piece.core.push_back(base);
    }
    if (!piece.core.empty()) out.push_back(piece);
  }
  return out;
}

TEST(BirthDeathMaps, ElementsThatCoverOneAnotherDoNotRaiseTheRate) {
  SimulateSnowOptions options = small_snow();
  options.elements = 80;
  const std::vector<Cable> whole = true_cables(simulate_snow(options)), seen = crossing(whole, 4, 160, 120);
  MapOptions plain;
  plain.bridge_gaps = false;
  const double truth = estimate_maps(whole, 160, 120, 60, plain).births_per_frame;
  EXPECT_GT(estimate_maps(seen, 160, 120, 60, plain).births_per_frame, 1.2 * truth);
  EXPECT_NEAR(estimate_maps(seen, 160, 120, 60).births_per_frame, truth, 0.07 * truth);
}

TEST(BirthDeathMaps, TrueBirthsInsideAreKept) {
  Rng rng(12);
  std::vector<Cable> cables;  // appear anywhere, live 20 frames, 30 at a time
  for (int i = 0; i < 300; ++i)
    cables.push_back(straight_cable(static_cast<std::int64_t>(rng.below(200)), 20, rng.uniform(10, 150),
                                    rng.uniform(10, 110), rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3)));
  MapOptions plain;
  plain.bridge_gaps = false;
  const double truth = estimate_maps(cables, 160, 120, 220, plain).births_per_frame;
  EXPECT_NEAR(estimate_maps(cables, 160, 120, 220).births_per_frame, truth, 0.08 * truth);
}

TEST(BirthDeathMaps, BrokenTracksDoNotRaiseTheRate) {
  const SimulatedScene scene = simulate_snow(small_snow());
  const std::vector<Cable> whole = true_cables(scene), cut = broken(whole, 0.5, 3);
  ASSERT_GT(cut.size(), whole.size() * 5 / 4);
  MapOptions plain;
  plain.bridge_gaps = false;
  const double truth = estimate_maps(whole, 160, 120, 60, plain).births_per_frame;
  EXPECT_GT(estimate_maps(cut, 160, 120, 60, plain).births_per_frame, 1.4 * truth);
  EXPECT_NEAR(estimate_maps(cut, 160, 120, 60).births_per_frame, truth, 0.05 * truth);
  EXPECT_NEAR(estimate_maps(whole, 160, 120, 60).births_per_frame, truth, 0.03 * truth);
}

TEST(BirthDeathMaps, HazardIsTheProbabilityToDie) {
  Rng rng(8);
  std::vector<Cable> cables;  // those on the right die with .2 a frame, those on the left with .02
  for (int i = 0; i < 600; ++i) {
    const double x = rng.uniform(5, 95), y = rng.uniform(5, 55), hazard = x > 50 ? 0.2 : 0.02;
    int life = 1;
    while (rng.uniform() >= hazard && life < 40) ++life;
    const int first = static_cast<int>(rng.below(40));
    cables.push_back(straight_cable(first, std::min(life, 40 - first), x, y, 0, 0));
  }
  MapOptions options;
  options.bandwidth = 6;
  options.bridge_gaps = false;
  const BirthDeathMaps maps = estimate_maps(cables, 100, 60, 40, options);
  EXPECT_NEAR(static_cast<double>(maps.hazard.at(80, 30)), 0.2, 0.06);
  EXPECT_NEAR(static_cast<double>(maps.hazard.at(20, 30)), 0.02, 0.015);
}

TEST(MapPictures, PaintedMapsComeBack) {
  Plane density(40, 30);
  density.at(10, 20) = 0.25F;
  density.at(30, 5) = 0.75F;
  const Plane back = density_of_image(image_of_density(density), 40, 30);
  EXPECT_NEAR(static_cast<double>(back.at(10, 20)), 0.25, 0.002);
  EXPECT_NEAR(static_cast<double>(back.at(30, 5)), 0.75, 0.002);
  const Plane smaller = density_of_image(image_of_density(density), 20, 15, 7);
  EXPECT_NEAR(sum_of(smaller), 7, 1e-4);
  EXPECT_NEAR(static_cast<double>(smaller.at(15, 2)), 0.75 * 7, 0.02);
  const Plane larger = density_of_image(image_of_density(density), 80, 90);
  EXPECT_NEAR(sum_of(larger), 1, 1e-4);
  EXPECT_EQ(std::max_element(larger.values.begin(), larger.values.end()) - larger.values.begin(), 16 * 80 + 60);

  Plane hazard(3, 1);
  hazard.values = {0, 0.01F, 1};
  const Plane hazard_back = hazard_of_image(image_of_hazard(hazard), 3, 1);
  EXPECT_EQ(hazard_back.values[0], 0);
  EXPECT_NEAR(static_cast<double>(hazard_back.values[1]), 0.01, 0.001);
  EXPECT_EQ(hazard_back.values[2], 1);
  EXPECT_THROW(density_of_image(image_of_density(Plane(4, 4)), 4, 4), InvalidInput);
  EXPECT_THROW(hazard_of_image(image_of_hazard(hazard), 0, 4), InvalidInput);
}

}  // namespace
}  // namespace motex
