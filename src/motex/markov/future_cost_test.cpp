// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/markov/future_cost.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

TEST(FutureCosts, LoopOfTwoIsAGeometricSum) {
  Graph graph(3);
  graph.add_edge(0, 1, 2);
  graph.add_edge(1, 0, 3);
  graph.add_edge(2, 0, 1);
  const std::vector<double> value = future_costs(graph, 0.5);
  EXPECT_NEAR(value[0], (2 + 0.5 * 3) / (1 - 0.25), 1e-12);
  EXPECT_NEAR(value[1], 3 + 0.5 * value[0], 1e-12);
  EXPECT_NEAR(value[2], 1 + 0.5 * value[0], 1e-12);
}

TEST(FutureCosts, AWayThatEndsCostsInfinitelyMuch) {
  Graph graph(4);  // 0 goes round; 1 → 2 → 3 ends
  graph.add_edge(0, 0, 1);
  graph.add_edge(0, 1, 0);
  graph.add_edge(1, 2, 0);
  graph.add_edge(2, 3, 0);
  const std::vector<double> value = future_costs(graph);
  EXPECT_NEAR(value[0], 1 / 0.005, 1e-9);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_TRUE(std::isinf(value[i]));
}

TEST(FutureCosts, FixedPointOfTheRecursionOnRandomGraphs) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    Graph graph(60);
    for (int k = 0; k < 110; ++k)
      graph.add_edge(static_cast<int>(rng.below(60)), static_cast<int>(rng.below(60)), rng.uniform(0, 5));
    const std::vector<double> value = future_costs(graph, 0.9);
    std::vector<double> iterated(60, 0);
    for (int sweep = 0; sweep < 500; ++sweep) {
      std::vector<double> next(60, std::numeric_limits<double>::infinity());
      for (std::size_t i = 0; i < 60; ++i)
        for (const Graph::Edge& edge : graph.successors[i])
          next[i] = std::min(next[i], edge.weight + 0.9 * iterated[static_cast<std::size_t>(edge.to)]);
      iterated = next;
    }
    for (std::size_t i = 0; i < 60; ++i) {
      if (std::isinf(iterated[i]))
        EXPECT_TRUE(std::isinf(value[i])) << i;
      else
        EXPECT_NEAR(value[i], iterated[i], 1e-9) << i;
    }
  }
}

TEST(FutureCosts, RefusesWhatHasNoSum) {
  Graph graph(1);
  graph.add_edge(0, 0, -1);
  EXPECT_THROW(future_costs(graph), InvalidInput);
  EXPECT_THROW(future_costs(Graph(1), 1), InvalidInput);
  EXPECT_TRUE(future_costs(Graph(0)).empty());
}

}  // namespace
}  // namespace motex
