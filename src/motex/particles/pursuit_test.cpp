// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/pursuit.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/particles/refine.h"
#include "motex/particles/response_tiles.h"

namespace motex {
namespace {

/// Bases of all kinds, far enough apart to be told from one another, on pixel noise.
struct Scene {
  std::vector<Base> bases;
  Plane image;
};

Scene planted_scene(int width, int height, double noise, std::uint64_t seed) {
  Rng rng(seed);
  Scene scene{{}, Plane(width, height)};
  int kind = 0;
  for (int y = 16; y < height - 12; y += 26)
    for (int x = 16; x < width - 12; x += 26) {
      Base base{static_cast<BaseKind>(kind++ % 4), x + rng.uniform() * 3, y + rng.uniform() * 3,
                0.9 + 1.5 * rng.uniform(),         3.1 * rng.uniform(),   {}};
      base.coefficients[0] = static_cast<float>((rng.uniform() < 0.5 ? -1 : 1) * (150 + 300 * rng.uniform()));
      if (base.kind == BaseKind::kLog || base.kind == BaseKind::kGaussian) base.angle = 0;
      scene.bases.push_back(base);
      add_patch(scene.image, render_patch(base, width, height), base.coefficients[0]);
    }
  for (float& value : scene.image.values) value += static_cast<float>(noise * rng.normal());
  return scene;
}

double energy(const Plane& plane) {
  double sum = 0;
  for (const float value : plane.values) sum += static_cast<double>(value) * value;
  return sum;
}

Plane difference(const Plane& a, const Plane& b) {
  Plane out = a;
  for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] -= b.values[i];
  return out;
}

TEST(Pursuit, RefusesWhatItCannotUse) {
  EXPECT_THROW(pursue_stages(Planes{}, {10}, {}), InvalidInput);
  EXPECT_THROW(pursue_stages(Planes(2, Plane(8, 8)), {10}, {}), InvalidInput);
  EXPECT_THROW(pursue_stages(Planes{Plane(0, 0)}, {10}, {}), InvalidInput);
  EXPECT_THROW(pursue_stages(Planes{Plane(8, 8)}, {10, 10}, {}), InvalidInput);
  EXPECT_THROW(pursue_stages(Planes{Plane(8, 8, std::numeric_limits<float>::quiet_NaN())}, {10}, {}), NumericalFailure);
  EXPECT_EQ(pursue_stages(Planes{Plane(40, 30)}, {10}, {}).at(0).bases.size(), 0U) << "nothing to be found in nothing";
  std::atomic<bool> cancel{true};
  JobContext job;
  job.cancel = &cancel;
  EXPECT_THROW(pursue_stages(Planes{Plane(40, 30, 5)}, {10}, {}, job), Cancelled);
}

TEST(Pursuit, TheDictionaryHasTheSizeOfThePaper) {
  std::size_t paper = 0, extended = 0;
  for (const LevelFilters& filters : make_filter_bank(Dictionary::kPaper, 320, 240)) paper += filters.bases.size();
  for (const LevelFilters& filters : make_filter_bank(Dictionary::kExtended, 320, 240))
    extended += filters.bases.size();
  EXPECT_EQ(paper, 200U);
  EXPECT_EQ(extended, 208U);
}

TEST(Pursuit, ResponsesAreCoefficients) {
  ResponseTiles tiles(Dictionary::kExtended, 144, 144);
  for (const LevelFilters& filters : make_filter_bank(Dictionary::kExtended, 144, 144))
    for (std::size_t j = 0; j < filters.bases.size(); j += 7) {
      Base base = filters.bases[j];
      base.x = base.y = 72;
      Plane image(144, 144);
      add_patch(image, render_patch(base, 144, 144), 100);
      tiles.set_residual(image);
      float response = 0;
      const Base found = tiles.strongest(response);
      EXPECT_NEAR(std::abs(response), 100, 12) << name_of(base.kind) << " " << base.scale;
      const FittedBase fitted = refine_base(image, found, 10);
      EXPECT_GT(std::abs(fitted.coefficient), 99) << name_of(base.kind) << " " << base.scale;
    }
}

TEST(Pursuit, FindsPlantedBases) {
  const Scene scene = planted_scene(220, 180, 2, 7);
  const auto num = static_cast<int>(scene.bases.size());
  const BaseMap map = pursue_stages({scene.image}, {num}, {}).at(0);
  int num_found = 0;
  for (const Base& truth : scene.bases)
    for (const Base& base : map.bases) {
      const double distance = std::hypot(base.x - truth.x, base.y - truth.y);
      const double turn = std::abs(std::remainder(base.angle - truth.angle, 3.14159265));
      if (base.kind == truth.kind && distance < 0.25 && std::abs(base.scale / truth.scale - 1) < 0.1 && turn < 0.1 &&
          std::abs(base.coefficients[0]) > 0.9F * std::abs(truth.coefficients[0])) {
        ++num_found;
        break;
      }
    }
  EXPECT_GT(num_found, num * 9 / 10);
  const Plane left = difference(scene.image, reconstruct(map, {Plane(220, 180)})[0]);
  EXPECT_LT(energy(left), 1.3 * 220 * 180 * 4) << "what is left is little more than the noise";
}

TEST(Pursuit, LocalUpdatesSeeWhatACompleteComputationSees) {
  const Scene scene = planted_scene(120, 100, 20, 3);
  ResponseTiles tiles(Dictionary::kExtended, 120, 100);
  Plane residual = scene.image;
  tiles.set_residual(residual);
  for (int step = 0; step < 60; ++step) {
    ResponseTiles fresh(Dictionary::kExtended, 120, 100);
    fresh.set_residual(residual);
    float local = 0, complete = 0;
    const FittedBase base = refine_base(residual, tiles.strongest(local), 4);
    fresh.strongest(complete);
    ASSERT_GT(std::abs(local), 0.93F * std::abs(complete)) << "step " << step;
    add_patch(residual, base.patch, -base.coefficient);
    tiles.changed(residual, base.patch);
  }
}

TEST(Pursuit, MoreBasesAreBetterAndRoundsHelp) {
  const Scene scene = planted_scene(160, 120, 15, 11);
  const std::vector<BaseMap> maps = pursue_stages({scene.image}, {20, 40, 80}, {});
  double before = energy(scene.image);
  for (const BaseMap& map : maps) {
    const double after = energy(difference(scene.image, reconstruct(map, {Plane(160, 120)})[0]));
    EXPECT_LT(after, before);
    before = after;
  }
  PursueOptions plain;
  plain.num_bases = 80;
  plain.refine_rounds = 0;
  plain.refine_steps = 0;
  const BaseMap on_grid = pursue({scene.image}, plain);
  EXPECT_LT(before, energy(difference(scene.image, reconstruct(on_grid, {Plane(160, 120)})[0])));
}

TEST(Pursuit, CoarseLevelsDoNotEndTheSearch) {
  Plane image(160, 120);  // what the paper's dictionary has no bases for
  Rng rng(9);
  for (int j = 0; j < 30; ++j)
    add_patch(
        image,
        render_patch({BaseKind::kGaussian, 160 * rng.uniform(), 120 * rng.uniform(), 1 + 3 * rng.uniform(), 0, {}}, 160,
                     120),
        400);
  for (float& value : image.values) value += static_cast<float>(2 * rng.normal());
  PursueOptions on_grid;
  on_grid.dictionary = Dictionary::kPaper;
  on_grid.num_bases = 500;
  on_grid.refine_steps = 0;
  EXPECT_EQ(pursue({image}, on_grid).bases.size(), 500U) << "the noise alone holds more";
}

TEST(Pursuit, ColourSharesGeometry) {
  Planes image(3, Plane(64, 64));
  const Base red{BaseKind::kGaussian, 20, 20, 2, 0, {}}, blue{BaseKind::kGaussian, 44, 40, 1.5, 0, {}};
  add_patch(image[0], render_patch(red, 64, 64), 400);
  add_patch(image[2], render_patch(blue, 64, 64), -300);
  const BaseMap map = pursue_stages(image, {2}, {}).at(0);
  ASSERT_EQ(map.bases.size(), 2U);
  EXPECT_NEAR(map.bases[0].coefficients[0], 400, 5);
  EXPECT_NEAR(map.bases[0].coefficients[2], 0, 5);
  EXPECT_NEAR(map.bases[1].coefficients[2], -300, 5);
}

TEST(Pursuit, SameImageSameBases) {
  const Scene scene = planted_scene(100, 80, 10, 5);
  const BaseMap a = pursue_stages({scene.image}, {40}, {}).at(0), b = pursue_stages({scene.image}, {40}, {}).at(0);
  ASSERT_EQ(a.bases.size(), b.bases.size());
  for (std::size_t j = 0; j < a.bases.size(); ++j) {
    EXPECT_EQ(a.bases[j].x, b.bases[j].x);
    EXPECT_EQ(a.bases[j].coefficients, b.bases[j].coefficients);
  }
}

TEST(Pursuit, TinyImagesWork) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {720, 8}, {5, 40}}) {
    Plane image(width, height);
    for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = static_cast<float>(20 + i * 37 % 100);
    const BaseMap map = pursue_stages({image}, {30}, {}).at(0);
    EXPECT_GT(map.bases.size(), 0U);
    EXPECT_LE(energy(difference(image, reconstruct(map, {Plane(width, height)})[0])), energy(image));
  }
}

TEST(RefineBase, FindsPlaceScaleAndAngle) {
  for (const BaseKind kind : {BaseKind::kLog, BaseKind::kGaborCos, BaseKind::kGaborSin, BaseKind::kGaussian}) {
    const bool round = kind == BaseKind::kLog || kind == BaseKind::kGaussian;
    const Base truth{kind, 40.37, 39.18, 2.3, round ? 0 : 0.9, {}};
    Plane image(80, 80);
    add_patch(image, render_patch(truth, 80, 80), -250);
    const FittedBase fitted = refine_base(image, {kind, 40, 40, 2.0, round ? 0 : 1.05, {}}, 12);
    EXPECT_NEAR(fitted.base.x, truth.x, 0.02) << name_of(kind);
    EXPECT_NEAR(fitted.base.y, truth.y, 0.02) << name_of(kind);
    EXPECT_NEAR(fitted.base.scale, truth.scale, 0.03) << name_of(kind);
    EXPECT_NEAR(fitted.base.angle, truth.angle, 0.02) << name_of(kind);
    EXPECT_NEAR(fitted.coefficient, -250, 1) << name_of(kind);
  }
}

TEST(RefineBase, EnergyNeverFalls) {
  const Scene scene = planted_scene(90, 90, 30, 2);
  Rng rng(4);
  for (int trial = 0; trial < 200; ++trial) {
    const Base start{static_cast<BaseKind>(trial % 4), 90 * rng.uniform(),  90 * rng.uniform(),
                     0.75 + 4 * rng.uniform(),         3.1 * rng.uniform(), {}};
    const double before = std::abs(refine_base(scene.image, start, 0).coefficient);
    EXPECT_GE(std::abs(refine_base(scene.image, start, 5).coefficient), 0.97 * before - 2);
  }
}

TEST(FitCoefficients, LeavesNothingAlongThePatches) {
  const Scene scene = planted_scene(90, 90, 30, 6);
  std::vector<BasePatch> patches;
  Rng rng(8);
  for (int j = 0; j < 60; ++j)
    patches.push_back(render_patch({static_cast<BaseKind>(j % 4),
                                    90 * rng.uniform(),
                                    90 * rng.uniform(),
                                    1 + 3 * rng.uniform(),
                                    3 * rng.uniform(),
                                    {}},
                                   90, 90));
  const std::vector<float> fit = fit_coefficients(scene.image, patches, std::vector<float>(60));
  Plane left = scene.image;
  for (std::size_t j = 0; j < patches.size(); ++j) add_patch(left, patches[j], -fit[j]);
  double before = 0, after = 0;
  for (const BasePatch& patch : patches) {
    before += std::pow(inner_product(patch, scene.image), 2);
    after += std::pow(inner_product(patch, left), 2);
  }
  EXPECT_LT(after, 1e-4 * before);
}

}  // namespace
}  // namespace motex
