// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/markov/paths.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <utility>

#include "motex/core/error.h"
#include "motex/markov/graph.h"

namespace motex {
namespace {

constexpr std::size_t kMostListed = 12;

std::size_t index(int state) { return static_cast<std::size_t>(state); }

void check_ends(const TransitionMatrix& transitions, std::initializer_list<int> states) {
  for (const int state : states) static_cast<void>(transitions.row_count(state));
}

std::string list_of(const std::vector<int>& states) {
  std::string text;
  for (std::size_t k = 0; k < std::min(states.size(), kMostListed); ++k) {
    text += (k > 0 ? ", " : "") + std::to_string(states[k]);
  }
  if (states.size() > kMostListed) text += " … (" + std::to_string(states.size()) + " in all)";
  return text;
}

[[noreturn]] void throw_unreachable(const Graph& graph, int from, int to) {
  const auto reachable = reachable_from(graph, from);
  const std::string from_name = "state " + std::to_string(from);
  throw InvalidInput("there is no path from " + from_name + " to state " + std::to_string(to) + "; " +
                     (reachable.empty() ? from_name + " has no successor"
                                        : "from " + from_name + " one reaches " + list_of(reachable)));
}

// Lowest-cost path from → to that avoids `closed` nodes and, as its first edge, `closed_first` nodes. Empty when none.
std::vector<int> dijkstra(const Graph& graph, int from, int to, const std::vector<bool>& closed,
                          const std::vector<int>& closed_first) {
  std::vector<double> cost(graph.successors.size(), std::numeric_limits<double>::infinity());
  std::vector<int> predecessor(graph.successors.size(), -1);
  using Open = std::pair<double, int>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  cost[index(from)] = 0;
  open.emplace(0.0, from);
  while (!open.empty() && open.top().second != to) {
    const auto [reached_cost, node] = open.top();
    open.pop();
    if (reached_cost > cost[index(node)]) continue;
    for (const auto& edge : graph.successors[index(node)]) {
      const double next = reached_cost + edge.weight;
      if (closed[index(edge.to)] || next >= cost[index(edge.to)]) continue;
      if (node == from && std::find(closed_first.begin(), closed_first.end(), edge.to) != closed_first.end()) continue;
      cost[index(edge.to)] = next;
      predecessor[index(edge.to)] = node;
      open.emplace(next, edge.to);
    }
  }
  std::vector<int> states;
  if (open.empty()) return states;
  for (int node = to; node != from; node = predecessor[index(node)]) states.push_back(node);
  states.push_back(from);
  std::reverse(states.begin(), states.end());
  return states;
}

// Yen: paths that follow `last` up to one of its states and leave it there by an edge that no found path takes.
void add_deviations(const TransitionMatrix& transitions, const Graph& graph, const std::vector<Path>& found,
                    std::vector<Path>& candidates) {
  const std::vector<int> last = found.back().states;
  std::vector<bool> closed(graph.successors.size(), false);
  for (std::size_t k = 0; k + 1 < last.size(); ++k) {
    std::vector<int> closed_first;
    for (const auto& path : found) {
      if (path.states.size() > k + 1 &&
          std::equal(last.begin(), last.begin() + static_cast<std::ptrdiff_t>(k) + 1, path.states.begin())) {
        closed_first.push_back(path.states[k + 1]);
      }
    }
    const auto tail = dijkstra(graph, last[k], last.back(), closed, closed_first);
    closed[index(last[k])] = true;
    if (tail.empty()) continue;
    Path path{{last.begin(), last.begin() + static_cast<std::ptrdiff_t>(k)}, 0};
    path.states.insert(path.states.end(), tail.begin(), tail.end());
    path.log_prob = path_log_prob(transitions, path.states);
    const auto same = [&](const Path& other) { return other.states == path.states; };
    if (std::none_of(candidates.begin(), candidates.end(), same)) candidates.push_back(std::move(path));
  }
}

// The best ways into one state at one step, best first.
struct Arrival {
  double log_prob;
  int predecessor;
  std::size_t rank;  // among the predecessor's arrivals
};
using Arrivals = std::vector<Arrival>;

void insert_arrival(Arrivals& arrivals, const Arrival& arrival, std::size_t count) {
  const auto place = std::upper_bound(arrivals.begin(), arrivals.end(), arrival,
                                      [](const Arrival& a, const Arrival& b) { return a.log_prob > b.log_prob; });
  if (place == arrivals.end() && arrivals.size() == count) return;
  arrivals.insert(place, arrival);
  if (arrivals.size() > count) arrivals.pop_back();
}

[[noreturn]] void throw_no_such_length(const Graph& graph, int from, int to, int length) {
  std::vector<bool> here(graph.successors.size(), false);
  here[index(from)] = true;
  int shorter = 0, longer = 0;
  for (int n = 1; n <= length + graph.num_nodes() && longer == 0; ++n) {
    if (here[index(to)]) (n < length ? shorter : longer) = n;
    std::vector<bool> next(here.size(), false);
    for (std::size_t node = 0; node < here.size(); ++node) {
      for (const auto& edge : graph.successors[node]) {
        if (here[node]) next[index(edge.to)] = true;
      }
    }
    here = std::move(next);
  }
  if (shorter == 0 && longer == 0) throw_unreachable(graph, from, to);
  std::string nearest = shorter > 0 ? std::to_string(shorter) : "";
  if (longer > 0) nearest += (nearest.empty() ? "" : " and ") + std::to_string(longer);
  throw InvalidInput("there is no path of " + std::to_string(length) + " states from state " + std::to_string(from) +
                     " to state " + std::to_string(to) + "; the nearest possible: " + nearest);
}

}  // namespace

double path_log_prob(const TransitionMatrix& transitions, std::span<const int> states) {
  double sum = 0;
  for (std::size_t k = 1; k < states.size(); ++k) sum += transitions.log_prob(states[k - 1], states[k]);
  return sum;
}

int sample_next(const TransitionMatrix& transitions, int state, Rng& rng) {
  if (transitions.is_dead_end(state)) {
    throw InvalidInput("state " + std::to_string(state) + " is a dead end; nothing follows it");
  }
  const double prior = transitions.prior_count();
  double left = rng.uniform() * (transitions.row_count(state) + prior) - prior;
  if (left < 0) return static_cast<int>(rng.below(static_cast<std::uint64_t>(transitions.num_states())));
  const auto row = transitions.counts_from(state);
  for (const auto& entry : row) {
    if ((left -= entry.count) < 0) return entry.to;
  }
  // Rounding has left a rest: past the last count, or (prior alone) at the end of the prior's mass.
  return row.empty() ? transitions.num_states() - 1 : row.back().to;
}

Path sample_path(const TransitionMatrix& transitions, int start, int length, Rng& rng) {
  check_ends(transitions, {start});
  if (length < 1) throw InvalidInput("a sampled path needs at least one state");
  Path path{{start}, 0};
  while (static_cast<int>(path.states.size()) < length) {
    const int from = path.states.back();
    if (transitions.is_dead_end(from)) {
      throw InvalidInput("the path from state " + std::to_string(start) + " came to state " + std::to_string(from) +
                         ", a dead end, after " + std::to_string(path.states.size()) + " of " + std::to_string(length) +
                         " states; walk inside the largest component");
    }
    path.states.push_back(sample_next(transitions, from, rng));
  }
  path.log_prob = path_log_prob(transitions, path.states);
  return path;
}

Path best_path(const TransitionMatrix& transitions, int from, int to) {
  return best_paths(transitions, from, to, 1).front();
}

std::vector<Path> best_paths(const TransitionMatrix& transitions, int from, int to, int count) {
  check_ends(transitions, {from, to});
  if (count < 1) throw InvalidInput("the number of best paths must be at least 1");
  const Graph graph = cost_graph(transitions);
  auto states = dijkstra(graph, from, to, std::vector<bool>(graph.successors.size(), false), {});
  if (states.empty()) throw_unreachable(graph, from, to);
  const double log_prob = path_log_prob(transitions, states);
  std::vector<Path> found = {{std::move(states), log_prob}};
  std::vector<Path> candidates;
  while (static_cast<int>(found.size()) < count) {
    add_deviations(transitions, graph, found, candidates);
    const auto best = std::max_element(candidates.begin(), candidates.end(),
                                       [](const Path& a, const Path& b) { return a.log_prob < b.log_prob; });
    if (best == candidates.end()) break;
    found.push_back(std::move(*best));
    candidates.erase(best);
  }
  return found;
}

Path best_path_of_length(const TransitionMatrix& transitions, int from, int to, int length) {
  return best_paths_of_length(transitions, from, to, length, 1).front();
}

std::vector<Path> best_paths_of_length(const TransitionMatrix& transitions, int from, int to, int length, int count) {
  check_ends(transitions, {from, to});
  if (length < 1 || count < 1) throw InvalidInput("the length of a path and the number of paths must be at least 1");
  const Graph graph = cost_graph(transitions);
  std::vector<std::vector<Arrivals>> steps(index(length), std::vector<Arrivals>(graph.successors.size()));
  steps[0][index(from)] = {{0.0, -1, 0}};
  for (std::size_t k = 1; k < steps.size(); ++k) {
    for (int l = 0; l < graph.num_nodes(); ++l) {
      const Arrivals& before = steps[k - 1][index(l)];
      for (std::size_t rank = 0; rank < before.size(); ++rank) {
        for (const auto& edge : graph.successors[index(l)]) {
          insert_arrival(steps[k][index(edge.to)], {before[rank].log_prob - edge.weight, l, rank}, index(count));
        }
      }
    }
  }
  if (steps.back()[index(to)].empty()) throw_no_such_length(graph, from, to, length);
  std::vector<Path> paths;
  for (std::size_t rank = 0; rank < steps.back()[index(to)].size(); ++rank) {
    Path path{std::vector<int>(index(length)), 0};
    int state = to;
    std::size_t r = rank;
    for (std::size_t k = steps.size(); k-- > 0;) {
      path.states[k] = state;
      const Arrival& arrival = steps[k][index(state)][r];
      state = arrival.predecessor;
      r = arrival.rank;
    }
    path.log_prob = path_log_prob(transitions, path.states);
    paths.push_back(std::move(path));
  }
  return paths;
}

std::vector<int> repeat_by_self_transition(std::span<const int> path, const TransitionMatrix& transitions, Rng& rng,
                                           int max_repeats) {
  if (max_repeats < 0) throw InvalidInput("max_repeats must not be negative");
  std::vector<int> result;
  for (const int state : path) {
    const double p = transitions.probability(state, state);
    result.push_back(state);
    for (int k = 0; k < max_repeats && rng.uniform() < p; ++k) result.push_back(state);
  }
  return result;
}

}  // namespace motex
