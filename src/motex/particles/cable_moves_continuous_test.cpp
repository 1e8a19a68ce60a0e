// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Moves over cables where states are continuous, with the proposals that are used on pictures: against sums over grids.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motex/particles/cable_moves.h"
#include "motex/particles/toy_cables.h"

namespace motex {
namespace {

/// On a continuous toy: one frame with a spot, at most one element. Birth and death must share the time as the integral
/// of the posterior over place, scale and amplitude says.
TEST(CableMovesContinuous, OneElementIsThereAsOftenAsItsIntegralSays) {
  CablePrior prior = toy_prior();
  prior.width = prior.height = 8;
  prior.max_per_frame = 1;
  prior.noise = 10;
  prior.amplitude = {40, 30};
  prior.log_scale = {0.4, 0.2};
  prior.density_first = 2e-8;
  prior.min_coefficient = 5;
  const CableLaw law(prior, 1);
  std::vector<Plane> pictures{Plane(8, 8)};
  Rng noise(2);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      pictures[0].at(x, y) =
          static_cast<float>(25 * std::exp(-((x - 4) * (x - 4) + (y - 3.5) * (y - 3.5)) / 4.4) + 4 * noise.normal());
  CableState state(pictures, {}, law);
  double integral = 0;
  constexpr int kSteps = 22;
  for (int a = 0; a < kSteps; ++a)
    for (int s = 0; s < kSteps; ++s)
      for (int y = 0; y < 2 * kSteps; ++y)
        for (int x = 0; x < 2 * kSteps; ++x) {
          const CoreState z{-1 + 10 * (x + 0.5) / (2 * kSteps), -1 + 10 * (y + 0.5) / (2 * kSteps),
                            -0.5 + 1.8 * (s + 0.5) / kSteps, 70 * (a + 0.5) / kSteps, 0};
          if (!law.is_possible(BaseKind::kGaussian, z)) continue;
          integral += std::exp(explained_by(state.image(0), BaseKind::kGaussian, z) / 200 + law.log_birth(z, 0));
        }
  integral *= 10.0 / (2 * kSteps) * 10.0 / (2 * kSteps) * 1.8 / kSteps * 70.0 / kSteps;
  const double expected = integral / (1 + integral);
  ASSERT_GT(expected, 0.1);
  ASSERT_LT(expected, 0.9);
  FittedCoreProposal proposal(prior);
  CableMoves chain(state, law, proposal, {0, 1}, Rng(7));
  double there = 0;
  constexpr int kProposals = 200000;
  for (int i = 0; i < kProposals; ++i) {
    chain.propose(i % 4 == 3 ? CableMove::kBirthDeath : CableMove::kDiffuse, 0);
    there += static_cast<double>(state.live(0).size()) / kProposals;
  }
  EXPECT_NEAR(there, expected, 0.03);
}

/// The level of a cable, all else kept: mean and deviation of its amplitude against sums over a grid.
TEST(CableMovesContinuous, LevelsHaveTheirPosterior) {
  CablePrior prior = toy_prior();
  prior.noise = 12;
  prior.amplitude = {50, 10};
  prior.log_scale = {0.4, 0.15};
  const CableLaw law(prior, kToyFrames);
  const std::vector<Plane> pictures = toy_pictures();
  Cable cable;
  for (int t = 0; t < kToyFrames; ++t) cable.core.push_back(core_base(BaseKind::kGaussian, {9.0 + t, 4, 0.3, 40, 0}));
  CableState state(pictures, {cable}, law);
  CableState empty(pictures, {}, law);
  double weight_sum = 0, mean = 0, square = 0, most = -1e300;
  for (int pass = 0; pass < 2; ++pass)
    for (double s = -0.6; s < 1.4; s += 0.02)
      for (double a = 10; a < 110; a += 1) {
        double log_p = 0;
        CoreState z{9, 4, s, a, 0};
        log_p += law.log_birth(z, 0);
        for (int t = 0; t < kToyFrames; ++t, z[kCoreX] += 1)
          log_p += explained_by(empty.image(t), BaseKind::kGaussian, z) / (2 * prior.noise * prior.noise);
        if (pass == 0) {
          most = std::max(most, log_p);
          continue;
        }
        const double weight = std::exp(log_p - most);
        weight_sum += weight;
        mean += weight * a;
        square += weight * a * a;
      }
  mean /= weight_sum;
  const double deviation = std::sqrt(square / weight_sum - mean * mean);
  FittedCoreProposal proposal(prior);
  CableMoves chain(state, law, proposal, {0, kToyFrames}, Rng(9));
  constexpr int kProposals = 40000;
  double sum = 0, squares = 0;
  for (int i = 0; i < kProposals; ++i) {
    chain.propose(CableMove::kLevel, i % kToyFrames);
    const double a = state.element(0, state.live(0)[0]).z[kCoreAmplitude];
    sum += a / kProposals;
    squares += a * a / kProposals;
  }
  EXPECT_NEAR(sum, mean, 0.035 * deviation);
  EXPECT_NEAR(std::sqrt(squares - sum * sum), deviation, 0.035 * deviation);
}

}  // namespace
}  // namespace motex
