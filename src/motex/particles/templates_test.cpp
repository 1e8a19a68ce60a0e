// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/templates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/particles/clusters.h"
#include "motex/particles/coils.h"
#include "motex/particles/moveton_patch.h"
#include "motex/particles/planted_movetons.h"
#include "motex/particles/sample_moveton.h"

namespace motex {
namespace {

std::array<float, kPatchSize> patch_of(const Base& core, const std::vector<Base>& coils) {
  std::vector<RelativeBase> relative;
  for (const Base& coil : coils) relative.push_back(relative_to(coil, core, 1));
  std::array<float, kPatchSize> out{};
  render_moveton(core.kind, relative, 1, out.data());
  return out;
}

double distance(const std::array<float, kPatchSize>& a, const std::array<float, kPatchSize>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < kPatchSize; ++i) sum += std::pow(static_cast<double>(a[i] - b[i]), 2);
  return sum;
}

TEST(MovetonPatch, ForgetsPlaceSizeAndBrightnessAndTheDirectionOfOrientedCores) {
  const Base core = planted_base(BaseKind::kGaborCos, 30, 40, 2, 0.3, 80);
  const Base coil = planted_base(BaseKind::kGaborSin, 33, 41, 1.5, 1.1, 40);
  Base moved = core;
  moved.x = 100.5;
  moved.y = 7;
  moved.scale = 5;
  moved.angle = 2.2;
  moved.coefficients[0] = -0.4F * core.coefficients[0];
  const Base moved_coil = placed_at(relative_to(coil, core, 1), moved, 1);
  EXPECT_LT(distance(patch_of(core, {coil}), patch_of(moved, {moved_coil})), 1e-6);
  EXPECT_GT(distance(patch_of(core, {coil}), patch_of(core, {})), 0.02);
  Base round = core, turned = core;
  round.kind = turned.kind = BaseKind::kGaussian;
  turned.angle = 1.5;
  EXPECT_EQ(relative_to(coil, round, 1).u, relative_to(coil, turned, 1).u) << "round cores have no direction";
}

TEST(MovetonPatch, RelativeAndBackIsTheSame) {
  Base core = planted_base(BaseKind::kGaborSin, 30, 40, 2, 0.7, 80),
       coil = planted_base(BaseKind::kLog, 28, 44, 1, 0, 9);
  core.coefficients = {100, 50, 20};
  coil.coefficients = {-5, 20, 7};
  const Base back = placed_at(relative_to(coil, core, 3), core, 3);
  EXPECT_NEAR(back.x, coil.x, 1e-9);
  EXPECT_NEAR(back.y, coil.y, 1e-9);
  EXPECT_NEAR(back.scale, coil.scale, 1e-9);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(back.coefficients[k], coil.coefficients[k], 1e-4);
}

TEST(ChooseClusters, FindsAsManyAsThereAre) {
  Rng rng(3);
  for (int truth = 1; truth <= 4; ++truth) {
    Matrix points(240, 3);
    for (Index i = 0; i < points.rows(); ++i) {
      const Index which = i % truth, pair = which / 2;
      points.row(i) << 4.0 * static_cast<double>(which) + 0.4 * rng.normal(),
          3.0 * static_cast<double>(pair) + 0.4 * rng.normal(), 0.4 * rng.normal();
    }
    const Clusters found = choose_clusters(points, {});
    EXPECT_EQ(found.num(), truth);
    for (Index i = truth; i < points.rows(); ++i)
      EXPECT_EQ(found.labels[static_cast<std::size_t>(i)], found.labels[static_cast<std::size_t>(i % truth)]);
  }
}

TEST(ChooseClusters, AFewOutliersAreNoCluster) {
  Rng rng(4);
  Matrix points(200, 2);
  for (Index i = 0; i < points.rows(); ++i) points.row(i) << (i < 3 ? 50 : 0) + rng.normal(), rng.normal();
  EXPECT_EQ(choose_clusters(points, {}).num(), 1);
}

TEST(LearnTemplates, RefusesAndAcceptsNothing) {
  std::vector<Cable> none;
  EXPECT_TRUE(learn_templates(none, 1).empty());
  LearnTemplatesOptions options;
  options.max_species = 0;
  EXPECT_THROW(learn_templates(none, 1, options), InvalidInput);
}

TEST(LearnTemplates, SpeciesAreToldApartAndConstantAlongCables) {
  const PlantedMovetons truth = plant_movetons(24, 14, 30, 1.5, 7);
  std::vector<Cable> cables = cores_of(truth.cables);
  grow_coils(truth.clip, truth.background, cables);
  const std::vector<MovetonTemplate> templates = learn_templates(cables, 1);
  ASSERT_EQ(templates.size(), 2U);
  for (std::size_t c = 0; c < cables.size(); ++c) EXPECT_EQ(cables[c].species, c < 14 ? 0 : 1) << "bird " << c;
  EXPECT_NEAR(templates[0].share, 14.0 / 24, 1e-9);
  EXPECT_EQ(templates[1].poses.size(), 1U);
  EXPECT_TRUE(templates[1].poses[0].coils.empty());
  EXPECT_LT(templates[1].amplitude.mean, -55);
  EXPECT_NEAR(templates[1].log_scale.mean, std::log(2.2), 0.12);
}

TEST(LearnTemplates, WingsAreStatesWithTheirTransitions) {
  const PlantedMovetons truth = plant_movetons(16, 16, 40, 1.5, 8);
  std::vector<Cable> cables = cores_of(truth.cables);
  grow_coils(truth.clip, truth.background, cables);
  const std::vector<MovetonTemplate> templates = learn_templates(cables, 1);
  ASSERT_EQ(templates.size(), 1U);
  ASSERT_EQ(templates[0].poses.size(), 3U);
  ASSERT_EQ(templates[0].pose_transitions.num_states(), 3);
  // which pose is which state: by most frames
  std::array<std::array<int, 3>, 3> together{};
  for (std::size_t c = 0; c < cables.size(); ++c) {
    ASSERT_EQ(cables[c].poses.size(), cables[c].core.size());
    for (std::size_t at = 0; at < cables[c].poses.size(); ++at)
      ++together[static_cast<std::size_t>(cables[c].poses[at])][static_cast<std::size_t>(truth.states[c][at])];
  }
  std::array<int, 3> state{};
  int agree = 0;
  for (std::size_t p = 0; p < 3; ++p) {
    state[p] = static_cast<int>(std::max_element(together[p].begin(), together[p].end()) - together[p].begin());
    agree += together[p][static_cast<std::size_t>(state[p])];
  }
  EXPECT_GT(agree, 16 * 40 * 95 / 100);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      EXPECT_NEAR(templates[0].pose_transitions.probability(a, b),
                  kFlap[state[static_cast<std::size_t>(a)]][state[static_cast<std::size_t>(b)]], 0.1);
}

TEST(LearnTemplates, WhatFadesIsNoRepeatingState) {
  std::vector<Cable> cables;
  Rng rng(2);
  for (int c = 0; c < 30; ++c) {  // a tail that vanishes after 10 of 20 frames, once
    Cable cable;
    cable.coils.resize(1);
    const int row = c / 6;
    for (int t = 0; t < 20; ++t) {
      cable.core.push_back(planted_base(BaseKind::kGaussian, 20.0 + 60 * (c % 6), 20.0 + 60 * row, 2, 0, 80));
      cable.coils[0].push_back(planted_base(BaseKind::kGaussian, cable.core.back().x + 4, cable.core.back().y, 2, 0,
                                            (t < 10 ? 60 : 2) + rng.normal()));
    }
    cables.push_back(std::move(cable));
  }
  const std::vector<MovetonTemplate> templates = learn_templates(cables, 1);
  ASSERT_EQ(templates.size(), 1U);
  EXPECT_EQ(templates[0].poses.size(), 1U);
}

TEST(LearnTemplates, HalfTurnsOfOrientedCoresDoNotMatter) {
  std::vector<Cable> cables;
  Rng rng(5);
  for (int c = 0; c < 24; ++c) {
    Cable cable;
    cable.coils.resize(1);
    const double angle = rng.uniform(0, 2) + (c % 2) * std::numbers::pi;
    const int row = c / 6;
    for (int t = 0; t < 6; ++t) {
      Base core = planted_base(BaseKind::kGaborCos, 20.0 + 60 * (c % 6), 20.0 + 60 * row, 2, angle, 80);
      RelativeBase tail{BaseKind::kGaussian, c % 2 == 0 ? 2.0 : -2.0, 0, 0, 0, {0.5}};
      cable.coils[0].push_back(placed_at(tail, core, 1));
      cable.core.push_back(core);
    }
    cables.push_back(std::move(cable));
  }
  const std::vector<MovetonTemplate> templates = learn_templates(cables, 1);
  ASSERT_EQ(templates.size(), 1U);
  ASSERT_EQ(templates[0].poses[0].coils.size(), 1U);
  EXPECT_NEAR(templates[0].poses[0].coils[0].u.mean, 2, 1e-6);
  EXPECT_EQ(templates[0].poses[0].coils[0].presence, 1);
}

MovetonTemplate flapping_template() {
  MovetonTemplate out;
  TemplateCoil wing;
  wing.u = {2, 0.1};
  wing.coefficient[0] = {0.5, 0.05};
  out.poses.resize(2);
  out.poses[0].coils = {wing, wing};
  out.poses[0].coils[1].presence = 0.3;
  out.poses[1].coils = {wing};
  out.pose_transitions = TransitionMatrix(2);
  out.pose_transitions.add_count(0, 0, 3);
  out.pose_transitions.add_count(0, 1, 1);
  out.pose_transitions.add_count(1, 0, 1);
  out.pose_transitions.add_count(1, 1, 1);
  out.log_scale = {std::log(3), 0.1};
  out.amplitude = {-70, 5};
  return out;
}

TEST(SampleMoveton, FollowsItsTemplate) {
  const MovetonTemplate of = flapping_template();
  Rng rng(9);
  double both = 0, scale = 0;
  for (int k = 0; k < 4000; ++k) {
    const std::vector<Base> bases = sample_moveton(of, 1, 50, 60, rng);
    EXPECT_EQ(bases[0].x, 50);
    EXPECT_LT(peak_amplitude(bases[0]), 0);
    scale += std::log(bases[0].scale) / 4000;
    both += bases.size() == 3 ? 1.0 / 4000 : 0;
    EXPECT_NEAR((bases[1].x - 50) / bases[0].scale, 2, 0.21);
  }
  EXPECT_NEAR(scale, std::log(3), 0.01);
  EXPECT_NEAR(both, 0.3, 0.03);
  EXPECT_THROW(sample_moveton(MovetonTemplate{}, 1, 0, 0, rng), InvalidInput);
}

TEST(SampleMoveton, CoilsGoWithTheCoreAndPosesFollowTheChain) {
  const MovetonTemplate of = flapping_template();
  Rng rng(10);
  Cable cable;
  for (int t = 0; t < 4000; ++t)
    cable.core.push_back(planted_base(BaseKind::kGaussian, t, 30, 2 + (t % 10) * 0.1, 0, -60));
  dress_cable(cable, of, 1, rng);
  ASSERT_GE(cable.coils.size(), 1U);
  ASSERT_EQ(cable.poses.size(), 4000U);
  std::array<double, 2> offset{-1, -1};
  double stays = 0, first = 0;
  for (std::size_t t = 0; t + 1 < cable.core.size(); ++t) {
    const auto pose = static_cast<std::size_t>(cable.poses[t]);
    const double u = (cable.coils[0][t].x - cable.core[t].x) / cable.core[t].scale;
    if (offset[pose] < 0) offset[pose] = u;
    ASSERT_NEAR(u, offset[pose], 1e-6) << "a moveton's own deformation is drawn once";
    first += pose == 0 ? 1 : 0;
    stays += pose == 0 && cable.poses[t + 1] == 0 ? 1 : 0;
  }
  EXPECT_NEAR(stays / first, 0.75, 0.04);
}

}  // namespace
}  // namespace motex
