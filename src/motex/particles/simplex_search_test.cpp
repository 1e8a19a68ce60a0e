// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/simplex_search.h"

#include <gtest/gtest.h>

#include <cmath>

namespace motex {
namespace {

TEST(SimplexSearch, FindsTheEndOfABentValley) {
  const auto valley = [](const std::vector<double>& p) {
    return 100 * std::pow(p[1] - p[0] * p[0], 2) + std::pow(1 - p[0], 2);
  };
  const SimplexResult result = minimise_by_simplex(valley, {-1.2, 1}, 0.5, 1e-12, 2000);
  EXPECT_NEAR(result.point[0], 1, 1e-4);
  EXPECT_NEAR(result.point[1], 1, 1e-4);
  EXPECT_LT(result.num_evaluations, 500);
}

TEST(SimplexSearch, StaysAwayFromWhatIsNotANumber) {
  const auto half = [](const std::vector<double>& p) { return p[0] < 0 ? std::nan("") : std::sqrt(p[0]) - p[0] / 8; };
  EXPECT_NEAR(minimise_by_simplex(half, {3}, 0.5, 1e-9, 500).point[0], 0, 1e-3);
}

TEST(SimplexSearch, StopsAfterSoManyEvaluations) {
  int calls = 0;
  const auto endless = [&](const std::vector<double>& p) {
    ++calls;
    return -p[0];
  };
  minimise_by_simplex(endless, {0, 0, 0}, 1, 1e-9, 40);
  EXPECT_LE(calls, 46);
}

}  // namespace
}  // namespace motex
