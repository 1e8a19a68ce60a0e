// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/base.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr BaseKind kKinds[] = {BaseKind::kLog, BaseKind::kGaborCos, BaseKind::kGaborSin, BaseKind::kGaussian,
                               BaseKind::kStreak};

/// ψ as its definition says, pixel by pixel.
double definition(const Base& base, double x, double y) {
  const double dx = x - base.x, dy = y - base.y, s = base.scale;
  const double u = dx * std::cos(base.angle) + dy * std::sin(base.angle);
  const double v = -dx * std::sin(base.angle) + dy * std::cos(base.angle);
  const double round = std::exp(-(dx * dx + dy * dy) / (2 * s * s));
  const double long_one = std::exp(-(u * u + v * v / 4) / (2 * s * s));
  switch (base.kind) {
    case BaseKind::kLog:
      return (2 - (dx * dx + dy * dy) / (s * s)) * round;
    case BaseKind::kGaborCos:
      return (std::cos(1.2 * u / s) - std::exp(-0.72)) * long_one;
    case BaseKind::kGaborSin:
      return std::sin(1.2 * u / s) * long_one;
    case BaseKind::kGaussian:
      return round;
    case BaseKind::kStreak:
      return long_one;
  }
  return 0;
}

TEST(Base, PixelsFollowTheDefinition) {
  for (const BaseKind kind : kKinds)
    for (const double scale : {0.75, 2.07, 8.0})
      for (const double angle : {0.0, 0.4, 1.7, 3.0}) {
        const Base base{kind, 30.3, 29.6, scale, angle, {}};
        std::vector<float> got(61 * 61);
        evaluate(base, 0, 0, 61, 61, got.data());
        for (int y = 0; y < 61; ++y)
          for (int x = 0; x < 61; ++x)
            ASSERT_NEAR(got[static_cast<std::size_t>(61 * y + x)], definition(base, x, y), 2e-6)
                << name_of(kind) << " scale " << scale << " at " << x << "," << y;
      }
}

TEST(Base, PatchesHaveUnitNormAndHoldNearlyAllOfIt) {
  for (const BaseKind kind : kKinds)
    for (const double scale : {0.75, 1.5, 8.0}) {
      const Base base{kind, 100.4, 90.7, scale, 0.6, {}};
      const BasePatch patch = render_patch(base, 200, 200);
      double energy = 0, all = 0;
      for (const float value : patch.values) energy += value * value;
      EXPECT_NEAR(energy, 1, 1e-5);
      double inside = 0;
      for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 200; ++x) {
          const double value = definition(base, x, y) * definition(base, x, y);
          all += value;
          if (x >= patch.left && x < patch.left + patch.width && y >= patch.top && y < patch.top + patch.height)
            inside += value;
        }
      EXPECT_GT(inside / all, 0.998) << name_of(kind) << " " << scale;
    }
}

TEST(Base, HalfATurnChangesTheSignOfTheEdgeOnly) {
  for (const BaseKind kind : {BaseKind::kGaborCos, BaseKind::kGaborSin, BaseKind::kStreak}) {
    const BasePatch a = render_patch({kind, 40, 40, 2, 0.3, {}}, 80, 80);
    const BasePatch b = render_patch({kind, 40, 40, 2, 0.3 + std::numbers::pi, {}}, 80, 80);
    Plane image(80, 80);
    add_patch(image, a, 1);
    EXPECT_NEAR(inner_product(b, image), kind == BaseKind::kGaborSin ? -1 : 1, 1e-4);
  }
}

TEST(Base, PatchesAreCutAtTheImage) {
  EXPECT_EQ(render_patch({BaseKind::kLog, -100, 5, 2, 0, {}}, 20, 20).values.size(), 0U);
  const BasePatch corner = render_patch({BaseKind::kGaussian, 0, 0, 2, 0, {}}, 20, 20);
  EXPECT_EQ(corner.left, 0);
  EXPECT_EQ(corner.top, 0);
  double energy = 0;
  for (const float value : corner.values) energy += value * value;
  EXPECT_NEAR(energy, 0.41, 0.02) << "about a quarter, and the pixels on the axes";
}

TEST(Base, ReconstructionIsTheSum) {
  BaseMap map{
      32, 24, 3, {{BaseKind::kGaussian, 10, 12, 1.5, 0, {100, 50, 0}}, {BaseKind::kLog, 20, 8, 1, 0, {9, 9, 9}}}};
  const Planes all = reconstruct(map, Planes(3, Plane(32, 24, 7))),
               one = reconstruct(map, Planes(3, Plane(32, 24, 7)), 1);
  const BasePatch first = render_patch(map.bases[0], 32, 24);
  EXPECT_NEAR(one[0].at(10, 12), 7 + 100 * first.row(12 - first.top)[10 - first.left], 1e-4);
  EXPECT_EQ(one[2].at(10, 12), 7);
  EXPECT_NE(all[2].at(20, 8), one[2].at(20, 8));
  EXPECT_THROW(reconstruct(map, Planes(1, Plane(32, 24))), InvalidInput);
}

}  // namespace
}  // namespace motex
