// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/lds/pinned_path.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/lds/bridge.h"
#include "motex/lds/synthetic.h"

namespace motex {
namespace {

FrameMatrix random_rows(Index rows, Index cols, std::uint64_t seed) {
  Rng rng(seed);
  FrameMatrix x(rows, cols);
  for (Index i = 0; i < x.size(); ++i) x.data()[i] = rng.normal();
  return x;
}

std::vector<bool> pinned_at(Index length, const std::vector<Index>& rows) {
  std::vector<bool> pinned(static_cast<std::size_t>(length), false);
  for (const Index row : rows) pinned[static_cast<std::size_t>(row)] = true;
  return pinned;
}

TEST(LeastNoisePath, WrongInputIsRefused) {
  Rng rng(1);
  const Lds lds = random_lds(rng, 2);
  FrameMatrix states = random_rows(8, 2, 1);
  EXPECT_THROW(least_noise_path(lds, pinned_at(8, {0}), states), InvalidInput);
  EXPECT_THROW(least_noise_path(lds, pinned_at(7, {0, 1}), states), InvalidInput);
  FrameMatrix wide = random_rows(8, 3, 1);
  EXPECT_THROW(least_noise_path(lds, pinned_at(8, {0, 1}), wide), InvalidInput);
}

TEST(LeastNoisePath, IsTheBridgeWhenTheEndsArePinned) {
  Rng rng(2);
  const Lds lds = random_lds(rng, 3);
  FrameMatrix states = random_rows(40, 3, 2), bridged = states;
  least_noise_path(lds, pinned_at(40, {0, 1, 38, 39}), states);
  Bridge(lds).solve(bridged, FrameMatrix::Zero(38, 3));
  EXPECT_LT((states - bridged).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(LeastNoisePath, IsAFreeRunWhenOnlyTheStartIsPinned) {
  Rng rng(3);
  const Lds lds = random_lds(rng, 3);
  FrameMatrix states = random_rows(30, 3, 3), run = states;
  EXPECT_NEAR(least_noise_path(lds, pinned_at(30, {0, 1}), states), 0, 1e-9);
  simulate(lds, run);
  EXPECT_LT((states - run).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(LeastNoisePath, HoldsWhatIsPinnedAndNoPathHasLess) {
  Rng rng(4);
  const Lds lds = random_lds(rng, 2);
  const FrameMatrix given = random_rows(25, 2, 4);
  const std::vector<bool> pinned = pinned_at(25, {0, 1, 9, 10, 17, 24});
  FrameMatrix states = given;
  const double least = least_noise_path(lds, pinned, states);
  for (const Index t : {0, 1, 9, 10, 17, 24}) EXPECT_EQ(states.row(t), given.row(t));
  const std::vector<bool> all(25, true);
  for (std::uint64_t seed = 10; seed < 30; ++seed) {
    FrameMatrix other = states + 1e-3 * random_rows(25, 2, seed);
    for (const Index t : {0, 1, 9, 10, 17, 24}) other.row(t) = given.row(t);
    EXPECT_GT(least_noise_path(lds, all, other), least);
  }
}

}  // namespace
}  // namespace motex
