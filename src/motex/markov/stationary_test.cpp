// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/markov/stationary.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/markov/paths.h"

namespace motex {
namespace {

TEST(StationaryShares, Errors) {
  TransitionMatrix chain(3);
  chain.add_count(0, 1);
  chain.add_count(1, 0);
  EXPECT_THROW(stationary_shares(chain, {}), InvalidInput);
  EXPECT_THROW(stationary_shares(chain, std::vector<int>{0, 1, 2}), InvalidInput);
  EXPECT_THROW(stationary_shares(chain, std::vector<int>{2}), InvalidInput);
  EXPECT_THROW(stationary_shares(chain, std::vector<int>{0}), InvalidInput);
}

TEST(StationaryShares, TwoStatesByHand) {
  TransitionMatrix chain(4);
  chain.add_count(1, 1, 7);
  chain.add_count(1, 3, 3);  // leaves with 0.3
  chain.add_count(3, 1, 1);  // leaves with 0.1
  chain.add_count(3, 3, 9);
  chain.add_count(3, 0, 100);  // not among them
  const auto shares = stationary_shares(chain, std::vector<int>{1, 3});
  EXPECT_NEAR(shares[0], 0.25, 1e-15);
  EXPECT_NEAR(shares[1], 0.75, 1e-15);
}

TEST(StationaryShares, StaysUnderTheChain) {
  Rng rng(3);
  TransitionMatrix chain(12);
  std::vector<int> all;
  for (int i = 0; i < 12; ++i) {
    all.push_back(i);
    chain.add_count(i, (i + 1) % 12, 1e-6 + rng.uniform());
    for (int k = 0; k < 3; ++k) chain.add_count(i, static_cast<int>(rng.below(12)), rng.uniform());
  }
  const auto shares = stationary_shares(chain, all);
  double total = 0;
  for (int j = 0; j < 12; ++j) {
    double next = 0;
    for (int i = 0; i < 12; ++i) next += shares[static_cast<std::size_t>(i)] * chain.probability(i, j);
    EXPECT_NEAR(next, shares[static_cast<std::size_t>(j)], 1e-14);
    total += next;
  }
  EXPECT_NEAR(total, 1, 1e-14);
}

}  // namespace
}  // namespace motex
