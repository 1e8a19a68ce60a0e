// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/simulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "motex/core/error.h"
#include "motex/particles/fit_dynamics.h"
#include "motex/particles/synthetic.h"

namespace motex {
namespace {

SimulateSnowOptions small_snow() {
  SimulateSnowOptions options;
  options.width = 120;
  options.height = 100;
  options.frames = 60;
  options.elements = 40;
  return options;
}

TEST(SimulateSnow, RejectsOptionsOutOfRange) {
  SimulateSnowOptions options = small_snow();
  options.persistence = 1;
  EXPECT_THROW(simulate_snow(options), InvalidInput);
  options = small_snow();
  options.min_size = 3;
  EXPECT_THROW(simulate_snow(options), InvalidInput);
}

TEST(SimulateSnow, SameSeedSameBytesAnotherSeedOthers) {
  const SimulatedScene a = simulate_snow(small_snow()), b = simulate_snow(small_snow());
  SimulateSnowOptions other = small_snow();
  other.seed = 2;
  EXPECT_EQ(a.frames[7].pixels, b.frames[7].pixels);
  EXPECT_NE(a.frames[7].pixels, simulate_snow(other).frames[7].pixels);
}

TEST(SimulateSnow, CountIsSteadyAndAsAsked) {
  SimulateSnowOptions options = small_snow();
  options.width = 240;
  options.height = 160;
  options.elements = 400;
  options.frames = 80;
  options.wind = -3;
  const SimulatedScene scene = simulate_snow(options);
  double early = 0, late = 0;
  for (const SimulatedPoint& point : scene.points) (point.frame < 40 ? early : late) += 1.0 / 40;
  EXPECT_NEAR(early, 400, 30);
  EXPECT_NEAR(late, 400, 30);
  for (const SimulatedPoint& point : scene.points) {
    EXPECT_TRUE(point.x >= -0.5 && point.x < 239.5 && point.y >= -0.5 && point.y < 159.5);
  }
}

TEST(SimulateSnow, ThePictureShowsTheFlakes) {
  SimulateSnowOptions options = small_snow();
  options.elements = 3;
  options.noise = 0;
  options.min_size = options.max_size = 1.5;
  const SimulatedScene scene = simulate_snow(options);
  for (const SimulatedPoint& point : scene.points) {
    if (point.frame != 5) continue;
    const int x = static_cast<int>(std::lround(point.x)), y = static_cast<int>(std::lround(point.y));
    const double lift = static_cast<double>(luma(scene.frames[5]).at(x, y) - luma(scene.background).at(x, y));
    EXPECT_GT(lift, 0.75 * point.amplitude);
  }
}

TEST(SimulateSnow, DynamicsAreThoseAskedFor) {
  SimulateSnowOptions options = small_snow();
  options.width = 200;
  options.height = 200;
  options.elements = 100;
  const MovetonDynamics dynamics = fit_dynamics(true_cables(simulate_snow(options)));
  EXPECT_NEAR(dynamics.x.persistence(), 0.7, 0.05);
  EXPECT_NEAR(dynamics.y.persistence(), 0.7, 0.05);
  EXPECT_NEAR(dynamics.x.d, 0.25, 0.02);
  EXPECT_NEAR(dynamics.x.mean_velocity(), -2, 0.05);
  EXPECT_NEAR(dynamics.y.mean_velocity(), 3, 0.05);
}

TEST(SimulateBirds, WingsFollowTheMatrix) {
  SimulateBirdsOptions options;
  options.width = 160;
  options.height = 120;
  options.elements = 20;
  options.frames = 80;
  const SimulatedScene scene = simulate_birds(options);
  std::vector<std::vector<int>> states;
  for (const Cable& cable : true_cables(scene)) states.push_back(cable.poses);
  const TransitionMatrix found = TransitionMatrix::from_sequences(3, states);
  ASSERT_GT(found.row_count(0) + found.row_count(1) + found.row_count(2), 250);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(found.probability(i, j), scene.wing_transitions.probability(i, j), 0.08);
  const ClipFrames clip = clip_frames_of(scene);
  EXPECT_FALSE(clip.colour.empty());
  double darkest = 255;
  for (const float value : clip.luma[40].values) darkest = std::min(darkest, static_cast<double>(value));
  EXPECT_LT(darkest, 100);
}

TEST(SimulateFireworks, SparksOfABurstLeaveOnePlace) {
  SimulateFireworksOptions options;
  options.width = 160;
  options.height = 120;
  options.frames = 80;
  options.bursts = 3;
  const SimulatedScene scene = simulate_fireworks(options);
  ASSERT_EQ(scene.bursts.size(), 3U);
  const std::vector<Cable> cables = true_cables(scene);
  for (const SimulatedBurst& burst : scene.bursts) {
    int near = 0;
    for (const Cable& cable : cables)
      if (static_cast<double>(cable.first_frame) == std::ceil(burst.frame) &&
          std::hypot(cable.core[0].x - burst.x, cable.core[0].y - burst.y) < 4)
        ++near;
    EXPECT_EQ(near, burst.num_sparks);
  }
  const MovetonDynamics dynamics = fit_dynamics(cables);
  EXPECT_NEAR(dynamics.x.persistence(), 0.965, 0.03);
  EXPECT_LT(dynamics.amplitude.a + dynamics.amplitude.b, 1.05);
}

TEST(FallingDots, FallAndAreSeenWhereTheyAre) {
  const FallingDots dots = make_falling_dots(16, 0);
  EXPECT_EQ(dots.clip.num_frames(), 16);
  ASSERT_GT(dots.cables.size(), 20U);
  for (const Cable& cable : dots.cables) {
    for (std::int64_t t = cable.first_frame; t < cable.end_frame(); ++t) {
      const Base& base = cable.at(t);
      const int x = static_cast<int>(std::lround(base.x)), y = static_cast<int>(std::lround(base.y));
      EXPECT_GT(dots.clip.luma[static_cast<std::size_t>(t)].at(x, y), 125);
      EXPECT_NEAR(peak_amplitude(base), 100, 0.1);
    }
  }
  const TexturedMotion model = make_falling_dots_model();
  EXPECT_NEAR(model.dynamics[0].x.mean_velocity(), 1, 1e-6);
  EXPECT_NEAR(model.dynamics[0].y.mean_velocity(), 2, 1e-6);
  EXPECT_GT(model.maps.births_per_frame, 1);
}

}  // namespace
}  // namespace motex
