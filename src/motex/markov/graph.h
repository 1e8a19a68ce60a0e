// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "motex/markov/transition_matrix.h"

namespace motex {

/// Directed graph over nodes 0 … N − 1 as lists of successors.
struct Graph {
  struct Edge {
    int to = 0;
    double weight = 0;
  };
  std::vector<std::vector<Edge>> successors;  ///< N

  explicit Graph(int num_nodes = 0) : successors(static_cast<std::size_t>(num_nodes)) {}
  int num_nodes() const { return static_cast<int>(successors.size()); }
  /// Throws InvalidInput for a node that does not exist.
  void add_edge(int from, int to, double weight = 1);
  Graph reversed() const;
};

/// Edges where a transition was counted; the weight is the count. The prior, which connects everything, is left out.
Graph counted_graph(const TransitionMatrix& transitions);
/// Edges where p_ij > 0; the weight is −log p_ij ≥ 0. With a prior these are all N² pairs.
Graph cost_graph(const TransitionMatrix& transitions);

/// Strongly connected components: sets of nodes that all reach one another. A node that no cycle passes is one by
/// itself.
struct Components {
  std::vector<int> component_of;          ///< N
  std::vector<std::vector<int>> members;  ///< rising; components by their smallest member
  /// The one with most members (of equals the first). InvalidInput when there are no nodes.
  const std::vector<int>& largest() const;
};
/// Tarjan's algorithm without recursion, O(nodes + edges).
Components strongly_connected_components(const Graph& graph);

/// Nodes without a successor, rising.
std::vector<int> dead_ends(const Graph& graph);
/// Nodes that a path of one or more edges leads to, rising; `node` itself only when it lies on a cycle.
std::vector<int> reachable_from(const Graph& graph, int node);

}  // namespace motex
