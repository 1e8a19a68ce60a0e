// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/carry_bases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/particles/clip_background.h"

namespace motex {
namespace {

constexpr int kWidth = 96, kHeight = 72, kFrames = 9;
constexpr double kVx = 1.3, kVy = 3.6;

/// Blobs, bars and edges of many sizes on grey that fall together; no two alike.
ClipFrames falling_pattern() {
  Rng rng(7);
  std::vector<Base> bases;
  for (int k = 0; k < 60; ++k) {
    Base base{static_cast<BaseKind>(rng.below(4)),
              rng.uniform(-20, kWidth),
              rng.uniform(-40, kHeight),
              rng.uniform(1.2, 3),
              0,
              {}};
    if (base.kind == BaseKind::kGaborCos || base.kind == BaseKind::kGaborSin) base.angle = rng.uniform(0, 3.14);
    base.coefficients[0] = static_cast<float>(rng.uniform(60, 200) * (rng.uniform() < 0.5 ? -1 : 1));
    bases.push_back(base);
  }
  ClipFrames clip{kWidth, kHeight, 25, {}, {}};
  for (int t = 0; t < kFrames; ++t) {
    BaseMap map{kWidth, kHeight, 1, bases};
    for (Base& base : map.bases) base.x += kVx * t, base.y += kVy * t;
    clip.luma.push_back(reconstruct(map, {Plane(kWidth, kHeight, 100)})[0]);
  }
  return clip;
}

TEST(FlowField, FindsTheVelocityOfAFallingPattern) {
  const ClipFrames clip = falling_pattern();
  const FlowField flow = estimate_flow_field(luma_residuals(clip, {Plane(kWidth, kHeight, 100)}));
  for (const double x : {24.0, 48.0, 72.0})
    for (const double y : {20.0, 36.0, 50.0}) {
      EXPECT_NEAR(flow.at(x, y).x, kVx, 0.3) << x << "," << y;
      EXPECT_NEAR(flow.at(x, y).y, kVy, 0.3) << x << "," << y;
    }
}

TEST(FlowField, DiffersFromPlaceToPlaceAndIsRefusedForOneFrame) {
  std::vector<Plane> residuals;
  for (int t = 0; t < 8; ++t) {
    Plane plane(96, 48);
    for (int k = 0; k < 40; ++k) {  // the left half falls, the right half moves sideways
      const bool left = k % 2 == 0;
      const Base blob{BaseKind::kGaussian,
                      left ? (k * 37) % 46 : 50 + std::fmod(k * 29 + 2.0 * t, 46),
                      left ? std::fmod(k * 17 + 3.0 * t, 48) : (k * 17) % 48,
                      1.5,
                      0,
                      {}};
      add_patch(plane, render_patch(blob, 96, 48), 100);
    }
    residuals.push_back(plane);
  }
  const FlowField flow = estimate_flow_field(residuals, {8, 24, 6, 4});
  EXPECT_NEAR(flow.at(20, 24).y, 3, 0.4);
  EXPECT_NEAR(flow.at(20, 24).x, 0, 0.4);
  EXPECT_NEAR(flow.at(76, 24).x, 2, 0.4);
  EXPECT_NEAR(flow.at(76, 24).y, 0, 0.4);
  EXPECT_THROW(estimate_flow_field({residuals[0]}), InvalidInput);
}

TEST(CarryBases, BasesLiveAsLongAsWhatTheyShow) {
  const ClipFrames clip = falling_pattern();
  const Planes background{Plane(kWidth, kHeight, 100)};
  CarryOptions options;
  options.num_bases = 60;
  const std::vector<Cable> cables = carry_bases(clip, background, options);
  const CarryReport report = measure_cables(clip, background, cables);
  EXPECT_GT(report.mean_life, 3.5);  // what enters at the top lives shorter than the clip
  EXPECT_GT(report.psnr, report.background_psnr + 12);
  EXPECT_LE(report.bases_per_frame, 60);
  // and move with it
  double dx = 0, dy = 0, weight = 0;
  for (const Cable& cable : cables)
    for (std::size_t k = 1; k < cable.core.size(); ++k) {
      const double w = std::abs(static_cast<double>(cable.core[k].coefficients[0]));
      dx += w * (cable.core[k].x - cable.core[k - 1].x);
      dy += w * (cable.core[k].y - cable.core[k - 1].y);
      weight += w;
    }
  EXPECT_NEAR(dx / weight, kVx, 0.15);
  EXPECT_NEAR(dy / weight, kVy, 0.15);
}

TEST(CarryBases, SameForAnyNumberOfThreadsAndAnglesDoNotJump) {
  const ClipFrames clip = falling_pattern();
  const Planes background{Plane(kWidth, kHeight, 100)};
  CarryOptions options;
  options.num_bases = 40;
  JobContext one, two;
  one.jobs = 1;
  two.jobs = 2;
  const std::vector<Cable> a = carry_bases(clip, background, options, one),
                           b = carry_bases(clip, background, options, two);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(a[k].first_frame, b[k].first_frame);
    ASSERT_EQ(a[k].core.size(), b[k].core.size());
    for (std::size_t t = 0; t < a[k].core.size(); ++t) {
      EXPECT_EQ(a[k].core[t].x, b[k].core[t].x);
      EXPECT_EQ(a[k].core[t].coefficients, b[k].core[t].coefficients);
      if (t > 0) {
        EXPECT_LT(std::abs(a[k].core[t].angle - a[k].core[t - 1].angle), 1.6);
      }
    }
  }
}

TEST(CarryBases, ColoursAreFittedAndBadInputIsRefused) {
  ClipFrames clip = falling_pattern();
  for (const Plane& plane : clip.luma) clip.colour.push_back(to_image(Planes{plane, plane, plane}));
  CarryOptions options;
  options.num_bases = 20;
  const Planes background(3, Plane(kWidth, kHeight, 100));
  clip.luma.resize(2);
  clip.colour.resize(2);
  const std::vector<Cable> cables = carry_bases(clip, background, options);
  for (const Cable& cable : cables) EXPECT_NEAR(cable.core[0].coefficients[2], cable.core[0].coefficients[0], 25);
  EXPECT_THROW(carry_bases(ClipFrames{}, background, options), InvalidInput);
  EXPECT_THROW(carry_bases(clip, {Plane(5, 5)}, options), InvalidInput);
  clip.colour.clear();
  EXPECT_THROW(carry_bases(clip, background, options), InvalidInput);
}

}  // namespace
}  // namespace motex
