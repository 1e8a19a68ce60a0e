// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/markov/future_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMaxIterations = 10000;

/// Nodes from which a path never has to end: those left when nodes without a successor among the rest are taken away.
std::vector<bool> endless_nodes(const Graph& graph) {
  const auto n = graph.successors.size();
  std::vector<std::size_t> num_left(n);
  std::vector<int> ended;
  for (std::size_t i = 0; i < n; ++i) {
    num_left[i] = graph.successors[i].size();
    if (num_left[i] == 0) ended.push_back(static_cast<int>(i));
  }
  const Graph reversed = graph.reversed();
  std::vector<bool> endless(n, true);
  while (!ended.empty()) {
    const auto node = static_cast<std::size_t>(ended.back());
    ended.pop_back();
    endless[node] = false;
    for (const Graph::Edge& edge : reversed.successors[node])
      if (--num_left[static_cast<std::size_t>(edge.to)] == 0) ended.push_back(edge.to);
  }
  return endless;
}

/// The cost of following one edge from each node for ever. Every such path ends in a cycle, whose sum is closed.
class Policy {
 public:
  explicit Policy(const Graph& graph) : graph_(graph), choice(graph.successors.size(), -1) {}

  std::vector<double> values(double discount) const {
    const std::size_t n = choice.size();
    std::vector<double> value(n, kInfinity);
    std::vector<int> visited(n, -1);
    std::vector<std::size_t> path;
    for (std::size_t start = 0; start < n; ++start) {
      path.clear();
      std::size_t i = start;
      while (choice[i] >= 0 && visited[i] < 0) {
        visited[i] = static_cast<int>(start);
        path.push_back(i);
        i = next(i);
      }
      if (!path.empty() && visited[i] == static_cast<int>(start)) close_cycle(i, discount, value);
      for (auto k = path.rbegin(); k != path.rend(); ++k)
        if (!std::isfinite(value[*k])) value[*k] = edge(*k).weight + discount * value[next(*k)];
    }
    return value;
  }

 private:
  const Graph& graph_;

 public:
  std::vector<int> choice;  ///< index of the edge, −1 = none

 private:
  const Graph::Edge& edge(std::size_t i) const { return graph_.successors[i][static_cast<std::size_t>(choice[i])]; }
  std::size_t next(std::size_t i) const { return static_cast<std::size_t>(edge(i).to); }
  void close_cycle(std::size_t node, double discount, std::vector<double>& value) const {
    double sum = 0, factor = 1;
    std::size_t i = node;
    do {
      sum += factor * edge(i).weight;
      factor *= discount;
      i = next(i);
    } while (i != node);
    value[node] = sum / (1 - factor);
  }
};

}  // namespace

std::vector<double> future_costs(const Graph& graph, double discount) {
  if (!(discount > 0 && discount < 1)) throw InvalidInput("a discount lies between 0 and 1, both excluded");
  for (const auto& edges : graph.successors)
    for (const Graph::Edge& edge : edges)
      if (!(edge.weight >= 0 && std::isfinite(edge.weight))) throw InvalidInput("costs are finite and not negative");
  const std::vector<bool> endless = endless_nodes(graph);
  Policy policy(graph);
  const std::size_t n = graph.successors.size();
  std::vector<double> value(n, 0);
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    bool changed = false;
    for (std::size_t i = 0; i < n; ++i) {
      if (!endless[i]) continue;
      const auto& edges = graph.successors[i];
      const auto cost = [&](std::size_t k) {
        const auto to = static_cast<std::size_t>(edges[k].to);
        return endless[to] ? edges[k].weight + discount * value[to] : kInfinity;
      };
      double best = policy.choice[i] < 0 ? kInfinity : cost(static_cast<std::size_t>(policy.choice[i]));
      for (std::size_t k = 0; k < edges.size(); ++k)
        // A choice is given up only for what is really cheaper: rounding must not make it wander for ever.
        if (cost(k) < best * (1 - 1e-12) || (policy.choice[i] < 0 && std::isfinite(cost(k))))
          best = std::min(best, cost(k)), policy.choice[i] = static_cast<int>(k), changed = true;
    }
    if (!changed) break;
    value = policy.values(discount);
  }
  for (std::size_t i = 0; i < n; ++i)
    if (!endless[i]) value[i] = kInfinity;
  return value;
}

}  // namespace motex
