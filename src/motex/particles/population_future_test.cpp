// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "motex/particles/fit_dynamics.h"
#include "motex/particles/motion_tally.h"
#include "motex/particles/synthesize.h"

namespace motex {
namespace {

constexpr int kWidth = 120, kHeight = 90;

bool is_inside(double x, double y) { return x >= -0.5 && y >= -0.5 && x < kWidth - 0.5 && y < kHeight - 0.5; }

struct Start {
  double x = 0, y = 0, angle = 0, speed = 1;
  std::int64_t frame = 0;
};

/// As long as it is in the picture and the clip lasts.
Cable flight(const Start& start, double turn, std::int64_t num_frames) {
  Cable cable;
  cable.first_frame = start.frame;
  double x = start.x, y = start.y, angle = start.angle;
  while (is_inside(x, y) && cable.end_frame() < num_frames) {
    Base base{BaseKind::kGaussian, x, y, 1, 0, {}};
    base.coefficients.fill(static_cast<float>(coefficient_of_peak(base, 100)));
    cable.core.push_back(base);
    x += start.speed * std::cos(angle);
    y += start.speed * std::sin(angle);
    angle += turn;
  }
  return cable;
}

TexturedMotion empty_model() {
  TexturedMotion model;
  model.width = kWidth;
  model.height = kHeight;
  model.num_frames = 120;
  model.maps.bandwidth = 5;
  return model;
}

/// Flights across the picture, each with a velocity of its own, two of them slow.
TexturedMotion few_flights(double turn) {
  TexturedMotion model = empty_model();
  Rng rng(5);
  for (int k = 0; k < 16; ++k) {
    const auto frame = static_cast<std::int64_t>(rng.below(90));
    const double x = rng.uniform(10, kWidth - 10), y = rng.uniform(10, kHeight - 10);
    const double speed = k < 2 ? 0.3 : 1.5 + 0.1 * k;
    model.cables.push_back(flight({x, y, 0.39 * k, speed, frame}, turn, model.num_frames));
  }
  model.dynamics.push_back(fit_dynamics(model.cables));
  return model;
}

/// Flights that come straight in over all borders and turn.
TexturedMotion few_that_enter() {
  TexturedMotion model = empty_model();
  constexpr double kQuarter = std::numbers::pi / 2;
  for (int k = 0; k < 12; ++k) {
    const int side = k % 4;
    const double along = 30 + 10.0 * (k / 4);
    const double x = side == 0   ? 0
                     : side == 2 ? kWidth - 1
                                 : along,
                 y = side == 1   ? 0
                     : side == 3 ? kHeight - 1
                                 : along;
    model.cables.push_back(flight({x, y, kQuarter * side, 1.2, 1 + 5 * k}, k % 2 == 0 ? 0.02 : -0.02, 120));
  }
  model.dynamics.push_back(fit_dynamics(model.cables));
  return model;
}

MotionTally tally_of(const std::vector<Cable>& cables, std::int64_t first, std::int64_t num_frames) {
  MotionTally tally(5);
  for (const Cable& cable : cables)
    for (std::int64_t t = std::max(first, cable.first_frame + 1); t < std::min(first + num_frames, cable.end_frame());
         ++t) {
      const Base &now = cable.at(t), &before = cable.at(t - 1);
      if (is_inside(now.x, now.y) && is_inside(before.x, before.y))
        tally.add_element(now.x - before.x, now.y - before.y);
    }
  tally.add_frames(static_cast<double>(num_frames));
  return tally;
}

/// Largest of the differences in speed, direction and number: mean over stretches of three runs.
double mean_apart(const TexturedMotion& model, double rate) {
  const MotionTally clip = tally_of(model.cables, 0, model.num_frames);
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SynthesizeParticlesOptions options;
    options.seed = seed;
    options.rate = rate;
    const std::vector<Cable> cables = synthesize_cables(model, options, 3 * model.num_frames);
    for (std::int64_t first = 0; first <= 2 * model.num_frames; first += model.num_frames / 2) {
      const MotionTally::Difference apart = tally_of(cables, first, model.num_frames).difference(clip);
      sum += std::max({apart.speed, apart.direction, std::abs(apart.count)}) / 15;
    }
  }
  return sum;
}

constexpr double kByChance = 1.0001;  // times as many births: what is edited is left to chance

TEST(PopulationFuture, AnyStretchOfFewIsLikeTheClip) {
  const TexturedMotion model = few_flights(0);
  const double chosen = mean_apart(model, 1), by_chance = mean_apart(model, kByChance);
  EXPECT_LT(chosen, 0.15);
  EXPECT_LT(chosen, 0.65 * by_chance);
}

TEST(PopulationFuture, SoItIsWhereFewTurn) {
  const TexturedMotion model = few_flights(0.02);
  const double chosen = mean_apart(model, 1), by_chance = mean_apart(model, kByChance);
  EXPECT_LT(chosen, 0.15);
  EXPECT_LT(chosen, 0.65 * by_chance);
}

double angle_of_step(const Cable& cable, std::int64_t frame) {
  const Base &from = cable.at(frame), &to = cable.at(frame + 1);
  return std::atan2(to.y - from.y, to.x - from.x);
}

/// Smallest angle between a direction and those in which the cables of a model begin.
double from_nearest_start(const TexturedMotion& model, double angle) {
  double least = std::numbers::pi;
  for (const Cable& cable : model.cables)
    least = std::min(least,
                     std::abs(std::remainder(angle - angle_of_step(cable, cable.first_frame), 2 * std::numbers::pi)));
  return least;
}

TEST(PopulationFuture, PathsBeginElsewhereAndLeadIn) {
  const TexturedMotion model = few_that_enter();
  const std::vector<Cable> cables = synthesize_cables(model, {}, 600);
  int num_born = 0, num_shifted = 0;
  for (const Cable& cable : cables) {
    if (cable.first_frame == 0 || cable.num_frames() < 2) continue;
    const Base& first = cable.core[0];
    const double angle = angle_of_step(cable, cable.first_frame);
    const std::array<double, 4> gaps{first.x, first.y, kWidth - 1 - first.x, kHeight - 1 - first.y};
    const std::array<double, 4> inwards{std::cos(angle), std::sin(angle), -std::cos(angle), -std::sin(angle)};
    const auto side = static_cast<std::size_t>(std::min_element(gaps.begin(), gaps.end()) - gaps.begin());
    EXPECT_LT(gaps[side], 3);
    EXPECT_GT(inwards[side], 0);
    ++num_born;
    num_shifted += from_nearest_start(model, angle) > 0.1 ? 1 : 0;
  }
  EXPECT_GT(num_born, 30);
  EXPECT_GT(num_shifted, num_born / 3);
}

}  // namespace
}  // namespace motex
