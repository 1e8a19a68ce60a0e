// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/markov/graph.h"

#include <algorithm>
#include <string>

#include "motex/core/error.h"

namespace motex {
namespace {

void check_node(const Graph& graph, int node) {
  if (node >= 0 && node < graph.num_nodes()) return;
  throw InvalidInput("graph: there is no node " + std::to_string(node) + "; nodes are 0 … " +
                     std::to_string(graph.num_nodes() - 1));
}

// Tarjan 1972: a component is complete when no node above its root on the stack reaches further down.
class Tarjan {
 public:
  explicit Tarjan(const Graph& graph)
      : graph_(graph),
        order_(graph.successors.size(), kUnseen),
        lowest_(graph.successors.size(), 0),
        component_of_(graph.successors.size(), kUnseen) {}

  std::vector<int> run() {
    for (int node = 0; node < graph_.num_nodes(); ++node) {
      if (order_[index(node)] == kUnseen) visit(node);
    }
    return component_of_;
  }

 private:
  static constexpr int kUnseen = -1;
  struct Call {
    int node;
    std::size_t next_edge;
  };
  static std::size_t index(int node) { return static_cast<std::size_t>(node); }

  void enter(int node) {
    order_[index(node)] = lowest_[index(node)] = num_seen_++;
    stack_.push_back(node);
    calls_.push_back({node, 0});
  }

  void visit(int root) {
    enter(root);
    while (!calls_.empty()) {
      const int node = calls_.back().node;
      const auto& edges = graph_.successors[index(node)];
      if (calls_.back().next_edge < edges.size()) {
        const int to = edges[calls_.back().next_edge++].to;
        if (order_[index(to)] == kUnseen) {
          enter(to);
        } else if (component_of_[index(to)] == kUnseen) {  // still on the stack
          lowest_[index(node)] = std::min(lowest_[index(node)], order_[index(to)]);
        }
      } else {
        leave(node);
      }
    }
  }

  void leave(int node) {
    calls_.pop_back();
    if (!calls_.empty()) {
      int& below = lowest_[index(calls_.back().node)];
      below = std::min(below, lowest_[index(node)]);
    }
    if (lowest_[index(node)] != order_[index(node)]) return;
    for (int member = -1; member != node;) {
      member = stack_.back();
      stack_.pop_back();
      component_of_[index(member)] = num_components_;
    }
    ++num_components_;
  }

  const Graph& graph_;
  std::vector<int> order_, lowest_, component_of_;
  std::vector<int> stack_;
  std::vector<Call> calls_;
  int num_seen_ = 0, num_components_ = 0;
};

}  // namespace

void Graph::add_edge(int from, int to, double weight) {
  check_node(*this, from);
  check_node(*this, to);
  successors[static_cast<std::size_t>(from)].push_back({to, weight});
}

Graph Graph::reversed() const {
  Graph result(num_nodes());
  for (int node = 0; node < num_nodes(); ++node) {
    for (const Edge& edge : successors[static_cast<std::size_t>(node)]) result.add_edge(edge.to, node, edge.weight);
  }
  return result;
}

Graph counted_graph(const TransitionMatrix& transitions) {
  Graph graph(transitions.num_states());
  for (const auto& entry : transitions.counts()) graph.add_edge(entry.from, entry.to, entry.count);
  return graph;
}

Graph cost_graph(const TransitionMatrix& transitions) {
  Graph graph(transitions.num_states());
  const auto log_transitions = transitions.log_transitions();
  for (int from = 0; from < graph.num_nodes(); ++from) {
    auto& edges = graph.successors[static_cast<std::size_t>(from)];
    const auto row = log_transitions.row(from);
    if (transitions.prior_count() > 0) {
      const double base = log_transitions.base[static_cast<std::size_t>(from)];
      for (int to = 0; to < graph.num_nodes(); ++to) edges.push_back({to, -base});
      for (const auto& entry : row) edges[static_cast<std::size_t>(entry.to)].weight = -entry.log_prob;
    } else {
      for (const auto& entry : row) edges.push_back({entry.to, -entry.log_prob});
    }
  }
  return graph;
}

Components strongly_connected_components(const Graph& graph) {
  Components result;
  result.component_of = Tarjan(graph).run();
  std::vector<int> number(result.component_of.size(), -1);  // Tarjan's number → ours, by smallest member
  for (int node = 0; node < graph.num_nodes(); ++node) {
    int& component = result.component_of[static_cast<std::size_t>(node)];
    int& ours = number[static_cast<std::size_t>(component)];
    if (ours < 0) {
      ours = static_cast<int>(result.members.size());
      result.members.emplace_back();
    }
    component = ours;
    result.members[static_cast<std::size_t>(ours)].push_back(node);
  }
  return result;
}

const std::vector<int>& Components::largest() const {
  if (members.empty()) throw InvalidInput("graph: there are no nodes, so there is no largest component");
  return *std::max_element(members.begin(), members.end(),
                           [](const auto& a, const auto& b) { return a.size() < b.size(); });
}

std::vector<int> dead_ends(const Graph& graph) {
  std::vector<int> result;
  for (int node = 0; node < graph.num_nodes(); ++node) {
    if (graph.successors[static_cast<std::size_t>(node)].empty()) result.push_back(node);
  }
  return result;
}

std::vector<int> reachable_from(const Graph& graph, int node) {
  check_node(graph, node);
  std::vector<bool> seen(graph.successors.size(), false);
  std::vector<int> open = {node}, result;
  while (!open.empty()) {
    const int from = open.back();
    open.pop_back();
    for (const auto& edge : graph.successors[static_cast<std::size_t>(from)]) {
      if (seen[static_cast<std::size_t>(edge.to)]) continue;
      seen[static_cast<std::size_t>(edge.to)] = true;
      result.push_back(edge.to);
      open.push_back(edge.to);
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace motex
