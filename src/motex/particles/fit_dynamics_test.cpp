// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/fit_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

struct Truth {
  double persistence = 0.7, noise = 0.25, spread = 0;
  double mean_x = -2, mean_y = 3;
  double error = 0;
  int num_cables = 150, num_frames = 30;
};

Base gaussian_at(double x, double y, double scale, double amplitude) {
  Base base;
  base.kind = BaseKind::kGaussian;
  base.x = x;
  base.y = y;
  base.scale = scale;
  base.coefficients[0] = static_cast<float>(coefficient_of_peak(base, amplitude));
  return base;
}

std::vector<Cable> make_cables(const Truth& truth, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Cable> cables;
  const double steady = truth.noise / std::sqrt(1 - truth.persistence * truth.persistence);
  for (int i = 0; i < truth.num_cables; ++i) {
    Cable cable;
    cable.first_frame = i % 7;
    const double mx = truth.mean_x + truth.spread * rng.normal(), my = truth.mean_y + truth.spread * rng.normal();
    double x = rng.uniform(0, 300), y = rng.uniform(0, 200);
    double vx = mx + steady * rng.normal(), vy = my + steady * rng.normal();
    const double scale = rng.uniform(0.9, 2.2), amplitude = rng.uniform(40, 110);
    for (int t = 0; t < truth.num_frames; ++t) {
      cable.core.push_back(
          gaussian_at(x + truth.error * rng.normal(), y + truth.error * rng.normal(), scale, amplitude));
      vx = mx + truth.persistence * (vx - mx) + truth.noise * rng.normal();
      vy = my + truth.persistence * (vy - my) + truth.noise * rng.normal();
      x += vx;
      y += vy;
    }
    cables.push_back(std::move(cable));
  }
  return cables;
}

double wind_error_degrees(const MovetonDynamics& dynamics, const Truth& truth) {
  return std::abs(std::atan2(dynamics.y.mean_velocity(), dynamics.x.mean_velocity()) -
                  std::atan2(truth.mean_y, truth.mean_x)) *
         180 / std::numbers::pi;
}

TEST(FitDynamics, RejectsOptionsOutOfRange) {
  FitDynamicsOptions options;
  options.position_error = -1;
  EXPECT_THROW(fit_dynamics({}, options), InvalidInput);
}

TEST(FitDynamics, WithoutCablesThePriorSpeaks) {
  const MovetonDynamics dynamics = fit_dynamics({});
  EXPECT_NEAR(dynamics.x.persistence(), 0.7, 1e-9);
  EXPECT_NEAR(dynamics.x.a + dynamics.x.b, 1, 1e-12);
  EXPECT_GT(dynamics.y.d, 0);
  EXPECT_EQ(dynamics.x.mean_velocity(), 0);
}

TEST(FitDynamics, CablesOfTwoFramesGiveVelocityButNotPersistence) {
  std::vector<Cable> cables;
  for (int i = 0; i < 3; ++i) {
    Cable cable;
    cable.first_frame = 1;
    cable.core = {gaussian_at(10, 10 + 5 * i, 1, 50), gaussian_at(12 + 0.1 * i, 11 + 5 * i, 1, 50)};
    cables.push_back(cable);
  }
  const MovetonDynamics dynamics = fit_dynamics(cables);
  EXPECT_NEAR(dynamics.x.persistence(), 0.7, 1e-6);
  EXPECT_NEAR(dynamics.x.mean_velocity(), 2.1, 1e-6);
  EXPECT_NEAR(dynamics.x.c0, 2.1, 1e-6);
  EXPECT_NEAR(dynamics.y.mean_velocity(), 1, 1e-6);
}

TEST(FitDynamics, ExactPlacesGiveTheTruth) {
  for (const double persistence : {0.0, 0.5, 0.7, 0.9}) {
    Truth truth;
    truth.persistence = persistence;
    const MovetonDynamics dynamics = fit_dynamics(make_cables(truth, 3));
    EXPECT_NEAR(dynamics.x.persistence(), persistence, 0.05);
    EXPECT_NEAR(dynamics.y.persistence(), persistence, 0.05);
    EXPECT_NEAR(dynamics.x.d, truth.noise, 0.02);
    EXPECT_LT(dynamics.x.c_spread, 0.05);
    EXPECT_LT(wind_error_degrees(dynamics, truth), 0.6);
    EXPECT_DOUBLE_EQ(dynamics.x.a + dynamics.x.b, 1);
  }
}

TEST(FitDynamics, ShortCablesDoNotBiasThePersistence) {
  Truth truth;
  truth.num_frames = 6;
  truth.num_cables = 1500;
  truth.spread = 0.4;
  const MovetonDynamics dynamics = fit_dynamics(make_cables(truth, 4));
  EXPECT_NEAR(dynamics.x.persistence(), 0.7, 0.05);
  EXPECT_NEAR(dynamics.y.persistence(), 0.7, 0.05);
}

TEST(FitDynamics, DriftOfEachCableIsToldFromPersistence) {
  Truth truth;
  truth.spread = 0.5;
  const MovetonDynamics dynamics = fit_dynamics(make_cables(truth, 5));
  EXPECT_NEAR(dynamics.x.persistence(), 0.7, 0.05);
  EXPECT_NEAR(dynamics.x.c_spread, 0.3 * 0.5, 0.03);
  EXPECT_GT(dynamics.x.c_slope, 0.1);  // who begins fast stays fast
}

TEST(FitDynamics, MeasuredPlacesGiveTheTruthWhereRegressionFails) {
  for (const std::uint64_t seed : {6U, 7U, 8U}) {
    for (const double error : {0.15, 0.3}) {
      Truth truth;
      truth.error = error;
      const std::vector<Cable> cables = make_cables(truth, seed);
      EXPECT_LT(fit_dynamics(cables).x.persistence(), 0.45);
      FitDynamicsOptions told, found;
      told.position_error = error;
      found.estimate_errors = true;
      FitDynamicsReport report;
      EXPECT_NEAR(fit_dynamics(cables, told).x.persistence(), 0.7, 0.05);
      const MovetonDynamics dynamics = fit_dynamics(cables, found, &report);
      EXPECT_NEAR(dynamics.x.persistence(), 0.7, 0.06);
      EXPECT_NEAR(dynamics.y.persistence(), 0.7, 0.06);
      EXPECT_NEAR(report.position_error_x, error, 0.02);
      EXPECT_NEAR(dynamics.x.d, truth.noise, 0.04);
    }
  }
}

TEST(FitDynamics, SwappedIdentitiesAreCutOut) {
  Truth truth;
  std::vector<Cable> cables = make_cables(truth, 9);
  for (std::size_t i = 0; i + 1 < 40; i += 2)
    for (std::size_t t = 15; t < 30; ++t) std::swap(cables[i].core[t], cables[i + 1].core[t]);
  FitDynamicsReport report;
  const MovetonDynamics dynamics = fit_dynamics(cables, {}, &report);
  EXPECT_GE(report.num_cuts, 70);
  EXPECT_NEAR(dynamics.x.persistence(), 0.7, 0.05);
  EXPECT_NEAR(dynamics.x.d, truth.noise, 0.02);
}

TEST(FitDynamics, SizesStayAboutTheirOwnLevel) {
  Rng rng(10);
  std::vector<Cable> cables;
  double mean_level = 0;
  for (int i = 0; i < 200; ++i) {
    Cable cable;
    const double level = 0.3 + 0.3 * rng.normal();
    mean_level += level / 200;
    double u = 0.1 * rng.normal();
    for (int t = 0; t < 25; ++t) {
      cable.core.push_back(gaussian_at(t, t, std::exp(level + u), 100));
      u = 0.6 * u + 0.08 * rng.normal();
    }
    cables.push_back(std::move(cable));
  }
  const CoordinateDynamics size = fit_dynamics(cables).log_scale;
  EXPECT_NEAR(size.a + size.b, 0.6, 0.06);
  EXPECT_NEAR(size.d, 0.08, 0.005);
  EXPECT_NEAR(size.c / (1 - size.a - size.b), mean_level, 0.02);
  EXPECT_NEAR(size.c_spread / (1 - size.a - size.b), 0.3, 0.05);
  EXPECT_GT(size.c_slope, 0.15);
  Rng drawing(1);
  double sum = 0;
  for (int i = 0; i < 1000; ++i) sum += draw_cable_constant(size, 0.9, drawing) / 1000;
  EXPECT_GT(sum / (1 - size.a - size.b), 0.6);  // large ones stay large
}

TEST(FitDynamics, FadingIsKept) {
  std::vector<Cable> cables;
  Rng rng(11);
  for (int i = 0; i < 60; ++i) {
    Cable cable;
    double amplitude = 180 + 20 * rng.normal();
    for (int t = 0; t < 30; ++t) {
      cable.core.push_back(gaussian_at(t, t, 1.2, amplitude));
      amplitude = 0.93 * amplitude + rng.normal();
    }
    cables.push_back(std::move(cable));
  }
  const CoordinateDynamics light = fit_dynamics(cables).amplitude;
  double before = 180, now = 0.93 * 180;
  for (int t = 2; t < 30; ++t) {
    const double next = light.a * now + light.b * before + light.c;
    before = now;
    now = next;
  }
  EXPECT_NEAR(now, 180 * std::pow(0.93, 29), 6);
}

}  // namespace
}  // namespace motex
