// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/markov/sliding_maximum.h"

#include <gtest/gtest.h>

#include <limits>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();

TEST(SlidingMaximum, RefusesNegativeSizes) {
  EXPECT_THROW(SlidingMaximum(-1, 3), InvalidInput);
  EXPECT_THROW(SlidingMaximum(3, -1), InvalidInput);
}

TEST(SlidingMaximum, AgreesWithLookingAtEveryRow) {
  constexpr int kLanes = 5, kRows = 70;
  Rng rng(1);
  for (const Index window : {0, 1, 2, 3, 7, 20, 200}) {
    for (const double forgotten : {0.0, 0.1}) {
      SlidingMaximum maximum(kLanes, window);
      std::vector<std::vector<double>> rows;
      std::vector<int> first(kLanes, 0);
      for (int t = 0; t < kRows; ++t) {
        auto& row = rows.emplace_back();
        for (int i = 0; i < kLanes; ++i) row.push_back(static_cast<double>(rng.below(12)));  // ties are common
        maximum.push(row.data());
        for (int i = 0; i < kLanes; ++i) {
          if (rng.uniform() < forgotten) {
            maximum.forget(i);
            first[static_cast<std::size_t>(i)] = t + 1;
          }
          double best = kNone;
          int position = -1;
          const int oldest = window == 0 ? 0 : std::max(0, t + 1 - static_cast<int>(window));
          for (int p = std::max(first[static_cast<std::size_t>(i)], oldest); p <= t; ++p) {
            const double value = rows[static_cast<std::size_t>(p)][static_cast<std::size_t>(i)];
            if (value > best) best = value, position = p;
          }
          EXPECT_EQ(maximum.values()[static_cast<std::size_t>(i)], best);
          EXPECT_EQ(maximum.positions()[static_cast<std::size_t>(i)], position);
        }
      }
    }
  }
}

}  // namespace
}  // namespace motex
