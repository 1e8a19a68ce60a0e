// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/markov/graph.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

Graph graph_of(int num_nodes, std::initializer_list<std::pair<int, int>> edges) {
  Graph graph(num_nodes);
  for (const auto& [from, to] : edges) graph.add_edge(from, to);
  return graph;
}

TEST(Graph, RefusesUnknownNodes) {
  Graph graph(2);
  EXPECT_THROW(graph.add_edge(0, 2), InvalidInput);
  EXPECT_THROW(reachable_from(graph, -1), InvalidInput);
  EXPECT_THROW(strongly_connected_components(Graph(0)).largest(), InvalidInput);
}

TEST(Graph, FindsComponentsDeadEndsAndReach) {
  // 0 ⇄ 1 → 2 → 3 → 4 → 2, 5 alone, 6 loops
  const Graph graph = graph_of(7, {{0, 1}, {1, 0}, {1, 2}, {2, 3}, {3, 4}, {4, 2}, {6, 6}});
  const auto components = strongly_connected_components(graph);
  const std::vector<std::vector<int>> expected = {{0, 1}, {2, 3, 4}, {5}, {6}};
  EXPECT_EQ(components.members, expected);
  EXPECT_EQ(components.component_of, (std::vector<int>{0, 0, 1, 1, 1, 2, 3}));
  EXPECT_EQ(components.largest(), expected[1]);
  EXPECT_EQ(dead_ends(graph), (std::vector<int>{5}));
  EXPECT_EQ(reachable_from(graph, 0), (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(reachable_from(graph, 3), (std::vector<int>{2, 3, 4}));
  EXPECT_EQ(reachable_from(graph, 6), (std::vector<int>{6}));
  EXPECT_TRUE(reachable_from(graph, 5).empty());
  EXPECT_EQ(reachable_from(graph.reversed(), 2), (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(Graph, ComponentsAreMutualReachability) {
  Rng rng(3);
  for (int round = 0; round < 200; ++round) {
    const int n = 1 + static_cast<int>(rng.below(14));
    Graph graph(n);
    for (int k = static_cast<int>(rng.below(2 * static_cast<std::uint64_t>(n) + 1)); k > 0; --k) {
      const int from = static_cast<int>(rng.below(static_cast<std::uint64_t>(n)));
      graph.add_edge(from, static_cast<int>(rng.below(static_cast<std::uint64_t>(n))));
    }
    std::vector<std::vector<int>> reach;
    for (int i = 0; i < n; ++i) reach.push_back(reachable_from(graph, i));
    const auto reaches = [&](int i, int j) {
      const auto& set = reach[static_cast<std::size_t>(i)];
      return std::binary_search(set.begin(), set.end(), j);
    };
    const auto component = strongly_connected_components(graph).component_of;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const bool together = component[static_cast<std::size_t>(i)] == component[static_cast<std::size_t>(j)];
        EXPECT_EQ(together, i == j || (reaches(i, j) && reaches(j, i)));
      }
    }
  }
}

TEST(Graph, ALongChainNeedsNoDeepStack) {
  const int n = 1000000;
  Graph graph(n);
  for (int i = 0; i + 1 < n; ++i) graph.add_edge(i, i + 1);
  EXPECT_EQ(strongly_connected_components(graph).members.size(), static_cast<std::size_t>(n));
  graph.add_edge(n - 1, 0);
  EXPECT_EQ(strongly_connected_components(graph).members.size(), 1U);
}

TEST(Graph, OfCountsAndOfCosts) {
  TransitionMatrix matrix(3);
  matrix.add_count(0, 1, 3);
  matrix.add_count(0, 2, 1);
  const Graph costs = cost_graph(matrix);
  ASSERT_EQ(costs.successors[0].size(), 2U);
  EXPECT_NEAR(costs.successors[0][1].weight, -std::log(0.25), 1e-15);
  matrix.set_prior_count(1);
  EXPECT_EQ(dead_ends(counted_graph(matrix)), (std::vector<int>{1, 2}));
  const Graph complete = cost_graph(matrix);
  for (int i = 0; i < 3; ++i) {
    const auto& edges = complete.successors[static_cast<std::size_t>(i)];
    ASSERT_EQ(edges.size(), 3U);
    for (const auto& edge : edges) EXPECT_NEAR(edge.weight, -matrix.log_prob(i, edge.to), 1e-15);
  }
}

}  // namespace
}  // namespace motex
