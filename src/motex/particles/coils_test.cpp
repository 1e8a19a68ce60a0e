// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/coils.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "motex/core/error.h"
#include "motex/particles/joint_fit.h"
#include "motex/particles/planted_movetons.h"

namespace motex {
namespace {

TEST(GrowCoils, RefusesWhatDoesNotFit) {
  PlantedMovetons scene = plant_movetons(2, 2, 4, 1, 1);
  EXPECT_THROW(grow_coils(scene.clip, Planes(3, scene.background[0]), scene.cables), InvalidInput);
  EXPECT_THROW(grow_coils(scene.clip, {Plane(10, 10)}, scene.cables), InvalidInput);
  GrowCoilsOptions options;
  options.max_coils = -1;
  EXPECT_THROW(grow_coils(scene.clip, scene.background, scene.cables, options), InvalidInput);
  std::atomic<bool> cancel{true};
  JobContext job;
  job.cancel = &cancel;
  EXPECT_THROW(grow_coils(scene.clip, scene.background, scene.cables, {}, job), Cancelled);
}

TEST(GrowCoils, FindsTheWingsOfBirdsAndNoneWhereThereAreNone) {
  const PlantedMovetons truth = plant_movetons(6, 3, 16, 1.5, 2);
  std::vector<Cable> cables = cores_of(truth.cables);
  const GrowCoilsReport report = grow_coils(truth.clip, truth.background, cables);
  EXPECT_GT(report.cores_psnr, report.background_psnr + 2);
  EXPECT_GT(report.psnr, 43) << "noise of 1.5 alone is 44.6 dB";
  EXPECT_EQ(report.isolated_share, 1);
  for (std::size_t c = 0; c < cables.size(); ++c) {
    EXPECT_EQ(cables[c].core.size(), 16U);
    for (const std::vector<Base>& coil : cables[c].coils) EXPECT_EQ(coil.size(), 16U);
    if (c >= 3) {
      EXPECT_TRUE(cables[c].coils.empty()) << "bird " << c << " has no wings";
      EXPECT_NEAR(peak_amplitude(cables[c].core[7]) / peak_amplitude(truth.cables[c].core[7]), 1, 0.05);
      continue;
    }
    EXPECT_GE(cables[c].coils.size(), 2U);
    EXPECT_LE(cables[c].coils.size(), 5U);
  }
}

TEST(GrowCoils, NeighboursDoNotTakeOneAnothersLight) {
  // a bare core beside a winged one: what the wings are is not given to it
  PlantedMovetons truth = plant_movetons(1, 1, 10, 1, 5);
  Cable bare;
  for (const Base& core : truth.cables[0].core) {
    bare.core.push_back(planted_base(BaseKind::kGaussian, core.x + 6.5 * core.scale, core.y, core.scale, 0, -70));
    const std::size_t at = bare.core.size() - 1;
    add_patch(truth.clip.luma[at], render_patch(bare.core.back(), truth.clip.width, truth.clip.height),
              bare.core.back().coefficients[0]);
  }
  std::vector<Cable> cables = cores_of({truth.cables[0], bare});
  grow_coils(truth.clip, truth.background, cables);
  double stolen = 0, own = 0;
  for (const std::vector<Base>& coil : cables[1].coils)
    for (const Base& base : coil) stolen += std::pow(static_cast<double>(base.coefficients[0]), 2);
  for (const Base& base : cables[1].core) own += std::pow(static_cast<double>(base.coefficients[0]), 2);
  EXPECT_LT(stolen, 0.02 * own);
  EXPECT_GE(cables[0].coils.size(), 2U);
}

TEST(GrowCoils, ColoursAreFittedPlaneByPlane) {
  const PlantedMovetons truth = plant_movetons(2, 2, 6, 0, 3);
  ClipFrames clip = truth.clip;
  constexpr double kColour[] = {0.5, 1, 1.4};  // darker in blue
  for (Plane& plane : clip.luma) {
    Planes planes(3, plane);
    for (std::size_t k = 0; k < 3; ++k)
      for (float& value : planes[k].values)
        value = static_cast<float>(150 + kColour[k] * (static_cast<double>(value) - 150));
    clip.colour.push_back(to_image(planes));
    plane = luma(planes);
  }
  std::vector<Cable> cables = cores_of(truth.cables);
  const GrowCoilsReport report = grow_coils(clip, Planes(3, truth.background[0]), cables);
  EXPECT_GT(report.psnr, report.cores_psnr + 2);
  for (const Cable& cable : cables) {
    const Base& core = cable.core[3];
    EXPECT_NEAR(static_cast<double>(core.coefficients[0]) / static_cast<double>(core.coefficients[1]), 0.5, 0.03);
    EXPECT_NEAR(luma_coefficient(core, 3) / static_cast<double>(core.coefficients[1]),
                0.299 * 0.5 + 0.587 + 0.114 * 1.4, 0.03);
  }
}

TEST(GrowCoils, ThreadsDoNotChangeTheResult) {
  const PlantedMovetons truth = plant_movetons(4, 3, 8, 2, 4);
  std::vector<Cable> one = cores_of(truth.cables), two = one;
  JobContext single, several;
  single.jobs = 1;
  several.jobs = 3;
  grow_coils(truth.clip, truth.background, one, {}, single);
  grow_coils(truth.clip, truth.background, two, {}, several);
  for (std::size_t c = 0; c < one.size(); ++c) {
    ASSERT_EQ(one[c].coils.size(), two[c].coils.size());
    for (std::size_t k = 0; k < one[c].coils.size(); ++k)
      for (std::size_t at = 0; at < one[c].coils[k].size(); ++at) {
        EXPECT_EQ(one[c].coils[k][at].x, two[c].coils[k][at].x);
        EXPECT_EQ(one[c].coils[k][at].coefficients, two[c].coils[k][at].coefficients);
      }
  }
}

TEST(GrowCoils, NothingIsNoError) {
  const PlantedMovetons truth = plant_movetons(2, 0, 3, 1, 6);
  std::vector<Cable> none;
  EXPECT_EQ(grow_coils(truth.clip, truth.background, none).bases_per_moveton, 0);
  std::vector<Cable> outside = cores_of(truth.cables);
  outside[0].first_frame = 100;
  for (Base& core : outside[1].core) core.x = -500;
  EXPECT_NO_THROW(grow_coils(truth.clip, truth.background, outside));
  EXPECT_TRUE(std::isfinite(outside[1].core[0].coefficients[0]));
}

TEST(JointFit, SeparatesWhatOverlaps) {
  const std::vector<Base> bases{{BaseKind::kGaussian, 20, 20, 2, 0, {}},
                                {BaseKind::kGaussian, 23, 20, 2, 0, {}},
                                {BaseKind::kGaborCos, 21, 23, 2, 0.4, {}},
                                {BaseKind::kGaussian, 60, 20, 2, 0, {}}};
  const std::vector<float> truth{300, -120, 80, 50};
  Plane image(80, 40);
  for (std::size_t j = 0; j < bases.size(); ++j) add_patch(image, render_patch(bases[j], 80, 40), truth[j]);
  const std::vector<float> fit = JointFit(bases, 80, 40, 0).solve(image, std::vector<float>(4, 0));
  for (std::size_t j = 0; j < fit.size(); ++j) EXPECT_NEAR(fit[j], truth[j], 0.05);
  const std::vector<float> held = JointFit(bases, 80, 40, 1e6).solve(image, {1, 2, 3, 4});
  EXPECT_NEAR(held[2], 3, 0.01) << "a strong ridge keeps the start";
}

}  // namespace
}  // namespace motex
