// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/regroup.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/particles/planted_movetons.h"
#include "motex/particles/templates.h"

namespace motex {
namespace {

TEST(CoilsOfMean, OneCoilForAPartThatAllHave) {
  std::vector<std::vector<RelativeBase>> movetons;
  Rng rng(1);
  for (int k = 0; k < 100; ++k)
    movetons.push_back({{BaseKind::kGaussian, 2.5 + 0.1 * rng.normal(), 1, std::log(0.8), 0, {0.5}}});
  const std::vector<RelativeBase> coils = coils_of_mean(movetons, BaseKind::kGaussian, 1, {});
  ASSERT_EQ(coils.size(), 1U);
  EXPECT_NEAR(coils[0].u, 2.5, 0.1);
  EXPECT_NEAR(coils[0].v, 1, 0.1);
  EXPECT_NEAR(coils[0].coefficient[0], 0.5, 0.05);
  EXPECT_TRUE(coils_of_mean({{}, {}}, BaseKind::kGaussian, 1, {}).empty());
}

TEST(RegroupCoils, TheSameCoilStandsForTheSamePartOfAllMovetons) {
  const PlantedMovetons truth = plant_movetons(12, 12, 30, 1.5, 8);
  std::vector<Cable> cables = cores_of(truth.cables);
  const GrowCoilsReport grown = grow_coils(truth.clip, truth.background, cables);
  ASSERT_EQ(learn_templates(cables, 1).size(), 1U);
  const GrowCoilsReport report = regroup_coils(truth.clip, truth.background, {}, cables);
  EXPECT_GT(report.psnr, grown.psnr - 0.6);
  const std::vector<MovetonTemplate> templates = learn_templates(cables, 1);
  ASSERT_EQ(templates.size(), 1U);
  ASSERT_EQ(templates[0].poses.size(), 3U);
  for (const TemplatePose& pose : templates[0].poses) {
    ASSERT_GE(pose.coils.size(), 2U);
    for (std::size_t j = 0; j < 2; ++j) {  // both wings, always
      EXPECT_GT(pose.coils[j].presence, 0.85);
      EXPECT_NEAR(std::abs(pose.coils[j].u.mean), 2, 0.4);
      EXPECT_LT(pose.coils[j].u.deviation, 0.4);
    }
    EXPECT_LT(pose.coils[0].u.mean * pose.coils[1].u.mean, 0) << "one to each side";
  }
}

TEST(RegroupCoils, CablesWithoutCommonCoilsKeepTheirOwn) {
  const PlantedMovetons truth = plant_movetons(4, 0, 10, 1, 3);
  std::vector<Cable> cables = cores_of(truth.cables);
  grow_coils(truth.clip, truth.background, cables);
  learn_templates(cables, 1);
  const std::vector<Cable> before = cables;
  regroup_coils(truth.clip, truth.background, {}, cables);
  for (std::size_t c = 0; c < cables.size(); ++c) EXPECT_EQ(cables[c].coils.size(), before[c].coils.size());
}

}  // namespace
}  // namespace motex
