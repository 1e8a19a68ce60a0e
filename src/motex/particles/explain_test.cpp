// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/explain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/particles/element_likelihood.h"

namespace motex {
namespace {

struct Weather {
  double vx = 1, vy = 3, deviation = 0.2, scale = 1.5, amplitude = 80;
  int per_frame = 2;
};

/// Elements that enter at the top and leave below.
TexturedMotion falling(const Weather& weather, std::uint64_t seed, int num_frames = 60) {
  Rng rng(seed);
  TexturedMotion clip;
  clip.width = 100;
  clip.height = 80;
  clip.num_frames = num_frames;
  for (int t = -40; t < num_frames; ++t)
    for (int k = 0; k < weather.per_frame; ++k) {
      Cable cable;
      double x = rng.uniform(-20, 110), y = rng.uniform(0, 4), vx = weather.vx, vy = weather.vy;
      const double s = weather.scale * std::exp(0.1 * rng.normal()), amplitude = weather.amplitude + 8 * rng.normal();
      for (int frame = t; frame < num_frames && y < 80; ++frame) {
        if (frame >= 0 && x >= 0 && x < 100) {
          Base base;
          base.kind = BaseKind::kGaussian;
          base.x = x;
          base.y = y;
          base.scale = s * std::exp(0.02 * rng.normal());
          base.coefficients[0] = static_cast<float>(coefficient_of_peak(base, amplitude + rng.normal()));
          if (cable.core.empty()) cable.first_frame = frame;
          cable.core.push_back(base);
        } else if (!cable.core.empty()) {
          break;
        }
        vx = 0.8 * vx + 0.2 * weather.vx + weather.deviation * rng.normal();
        vy = 0.8 * vy + 0.2 * weather.vy + weather.deviation * rng.normal();
        x += vx;
        y += vy;
      }
      if (cable.core.size() > 2) clip.cables.push_back(cable);
    }
  return clip;
}

const Weather kCalm{1, 3, 0.2, 1.5, 80, 2}, kStorm{-4, 3, 0.2, 1.5, 80, 2}, kLarge{1, 3, 0.2, 3, 80, 2},
    kDark{1, 3, 0.2, 1.5, -80, 2}, kDense{1, 3, 0.2, 1.5, 80, 6}, kRough{1, 3, 0.9, 1.5, 80, 2};
const std::vector<Weather> kAll{kCalm, kStorm, kLarge, kDark, kDense, kRough};

TEST(Explain, EachClipIsExplainedBestByItsOwnModel) {
  // A model of fewer elements may lose against one of the same weather that has seen three times as many.
  std::vector<TexturedMotion> models;
  for (const Weather& weather : kAll) models.push_back(falling(weather, 1, 180));
  for (std::size_t truth = 0; truth < kAll.size(); ++truth) {
    const TexturedMotion clip = falling(kAll[truth], 77, 40);
    std::vector<Explanation> all;
    for (const TexturedMotion& model : models) all.push_back(explain_cables(model, clip));
    for (std::size_t k = 0; k < all.size(); ++k)
      if (k != truth) {
        EXPECT_GT(all[truth].total(), all[k].total() + 5) << "weather " << truth << ", model " << k;
      }
    const std::vector<double> shares = model_probabilities(all);
    EXPECT_GT(shares[truth], 0.99);
  }
}

TEST(Explain, ThePartThatDiffersSaysSo) {
  const TexturedMotion clip = falling(kCalm, 77, 40);
  const auto under = [&](const Weather& weather) { return explain_cables(falling(weather, 1), clip); };
  const Explanation own = under(kCalm);
  const Explanation storm = under(kStorm), large = under(kLarge), dense = under(kDense);
  EXPECT_GT(own.motion - storm.motion, 10 * std::abs(own.looks - storm.looks));
  EXPECT_GT(own.looks - large.looks, 10 * std::abs(own.motion - large.motion));
  EXPECT_GT(own.births - dense.births, 20);
}

TEST(Explain, AClipOfTwiceTheTimeHasTwiceTheNats) {
  const TexturedMotion model = falling(kCalm, 1);
  const Explanation once = explain_cables(model, falling(kCalm, 5, 60)),
                    twice = explain_cables(model, falling(kCalm, 6, 120));
  EXPECT_NEAR(twice.per_element(), once.per_element(), 0.15);
  EXPECT_GT(std::abs(once.motion), 50 * 0.15);
  EXPECT_NEAR(once.total(), once.births + once.places + once.looks + once.motion + once.deaths, 1e-9);
}

TEST(Explain, WhatGoesAgainstTheStreamIsAbnormal) {
  const TexturedMotion model = falling(kCalm, 1, 180);
  TexturedMotion clip = falling(kCalm, 9, 40);
  Cable rising = clip.cables[0];
  rising.first_frame = 15;
  rising.core.resize(20, rising.core[0]);
  for (std::size_t k = 0; k < 20; ++k) {
    rising.core[k] = rising.core[0];
    rising.core[k].x = 70;
    rising.core[k].y = 60 - 2.5 * static_cast<double>(k);
  }
  const std::vector<double> before = abnormality_over_time(clip, explain_cables(model, clip));
  clip.cables.push_back(rising);
  const Explanation all = explain_cables(model, clip);
  double of_rising = 0, of_others = 0, num_others = 0;
  for (std::size_t c = 0; c < clip.cables.size(); ++c)
    for (std::size_t k = 1; k < all.surprise[c].size(); ++k) {
      if (c + 1 == clip.cables.size()) {
        of_rising += all.surprise[c][k] / 19;
      } else {
        of_others += all.surprise[c][k];
        ++num_others;
      }
    }
  EXPECT_NEAR(of_others / num_others, 0, 0.3);
  EXPECT_GT(of_rising, 2);
  const Plane map = abnormality_map(clip, all, 4);
  EXPECT_GT(map.at(70, 40), 3 * map.at(30, 40));
  const std::vector<double> time = abnormality_over_time(clip, all);
  EXPECT_EQ(time[5], before[5]);
  EXPECT_GT(time[16], before[16] + 2);
}

TEST(Explain, DensitiesSumToOne) {
  double sum = 0;
  for (int k = -6000; k < 6000; ++k) sum += std::exp(log_density(0.01 * k, 0.3, 0.5)) * 0.01;
  EXPECT_NEAR(sum, 1, 1e-3);
  // A step of a coordinate whose constant is uncertain, over all values.
  CoordinateDynamics dynamics;
  dynamics.a = 1.7;
  dynamics.b = -0.7;
  dynamics.c = 0.3;
  dynamics.d = 0.4;
  dynamics.c_spread = 0.5;
  sum = 0;
  for (int k = -6000; k < 6000; ++k) {
    CoordinateLikelihood coordinate(dynamics, 0.01, true);
    coordinate.start(0);
    coordinate.next(1);
    coordinate.next(2.1);
    sum += std::exp(coordinate.next(0.01 * k)) * 0.01;
  }
  EXPECT_NEAR(sum, 1, 1e-3);
}

TEST(Explain, TheOwnDriftOfACableIsLearnedAlongIt) {
  CoordinateDynamics dynamics;
  dynamics.a = 1;
  dynamics.b = 0;
  dynamics.d = 0.1;
  dynamics.d0 = 2;
  dynamics.c_spread = 2;
  CoordinateLikelihood coordinate(dynamics, 0.01, true);
  coordinate.start(0);
  coordinate.next(2);
  const double early = coordinate.next(4);
  double late = 0;
  for (int k = 3; k < 10; ++k) late = coordinate.next(2 * k);
  EXPECT_GT(late, early + 2);
}

TEST(Explain, NothingExplainsNothing) {
  const TexturedMotion model = falling(kCalm, 1), empty;
  EXPECT_THROW(explain_cables(empty, model), InvalidInput);
  EXPECT_THROW(explain_cables(model, empty), InvalidInput);
}

}  // namespace
}  // namespace motex
