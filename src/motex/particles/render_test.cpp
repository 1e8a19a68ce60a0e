// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/render.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

std::vector<Base> random_bases(int num, double min_scale, double max_scale, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Base> bases;
  for (int k = 0; k < num; ++k) {
    Base base;
    base.kind = static_cast<BaseKind>(rng.below(kNumBaseKinds));
    base.x = rng.uniform(-6, 70);
    base.y = rng.uniform(-6, 54);
    base.scale = rng.uniform(min_scale, max_scale);
    base.angle = rng.uniform(0, std::numbers::pi);
    for (float& c : base.coefficients) c = static_cast<float>(rng.uniform(-300, 300));
    bases.push_back(base);
  }
  return bases;
}

double largest_difference(const Planes& a, const Planes& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].values.size(); ++i)
      largest = std::max(largest, std::abs(static_cast<double>(a[k].values[i] - b[k].values[i])));
  return largest;
}

TEST(BaseRenderer, RefusesWhatItCannotDraw) {
  EXPECT_THROW(BaseRenderer(0), InvalidInput);
  EXPECT_THROW(BaseRenderer(std::nan("")), InvalidInput);
  Planes planes(2, Plane(4, 4));
  EXPECT_THROW(BaseRenderer().add({}, planes), InvalidInput);
}

TEST(BaseRenderer, EqualsTheReconstruction) {
  for (const int num_planes : {1, 3}) {
    BaseMap map{64, 48, num_planes, random_bases(200, 0.5, 8, 3)};
    const Planes background(static_cast<std::size_t>(num_planes), Plane(64, 48, 100));
    Planes fast = background;
    BaseRenderer renderer;
    renderer.add(map.bases, fast);
    EXPECT_LT(largest_difference(fast, reconstruct(map, background)), 0.02);
  }
}

TEST(BaseRenderer, KeepsNothingOfTheBasesBefore) {
  const std::vector<Base> bases = random_bases(40, 0.7, 8, 4);
  BaseRenderer used, fresh;
  Planes a(1, Plane(64, 48)), b = a;
  used.add(random_bases(40, 5, 8, 5), a);
  a = b;
  used.add(bases, a);
  fresh.add(bases, b);
  EXPECT_EQ(largest_difference(a, b), 0);
}

/// At m times the resolution a pixel of the original is the mean of m × m pixels, near enough for smooth bases.
TEST(BaseRenderer, MagnifiedIsTheSamePicture) {
  const std::vector<Base> bases = random_bases(60, 2.5, 6, 6);
  Planes small(1, Plane(64, 48)), large(1, Plane(192, 144));
  BaseRenderer().add(bases, small);
  BaseRenderer(3).add(bases, large);
  double squares = 0, energy = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const double centre = static_cast<double>(large[0].at(3 * x + 1, 3 * y + 1) - small[0].at(x, y));
      squares += centre * centre;
      energy += std::pow(static_cast<double>(small[0].at(x, y)), 2);
    }
  EXPECT_LT(std::sqrt(squares / energy), 0.003);
  Planes half(1, Plane(32, 24));
  BaseRenderer(0.5).add(bases, half);
  EXPECT_NEAR(half[0].at(10, 10),
              (small[0].at(20, 20) + small[0].at(21, 20) + small[0].at(20, 21) + small[0].at(21, 21)) / 4, 2);
}

TEST(BaseRenderer, PassesOverWhatIsNotFinite) {
  std::vector<Base> bases(3);
  bases[0].x = std::numeric_limits<double>::quiet_NaN();
  bases[1].scale = 0;
  bases[2].y = 1e300;
  for (Base& base : bases) base.coefficients = {100, 100, 100};
  Planes planes(1, Plane(8, 8));
  BaseRenderer().add(bases, planes);
  EXPECT_EQ(largest_difference(planes, Planes(1, Plane(8, 8))), 0);
}

}  // namespace
}  // namespace motex
