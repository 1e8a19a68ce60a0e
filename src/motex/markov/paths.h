// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "motex/core/rng.h"
#include "motex/markov/transition_matrix.h"

namespace motex {

/// States in order, and Σ log M over their transitions (0 for one state).
struct Path {
  std::vector<int> states;
  double log_prob = 0;
};

/// The next state after `state`, drawn from its row; cost by the counts of that row, not by N. Throws InvalidInput at a
/// dead end.
int sample_next(const TransitionMatrix& transitions, int state, Rng& rng);

/// `length` states drawn from the chain, the first given. Throws InvalidInput when a dead end comes before that; walk
/// in the largest component (graph.h, TransitionMatrix::restricted_to) to avoid it.
Path sample_path(const TransitionMatrix& transitions, int start, int length, Rng& rng);

/// Lowest-cost path by Dijkstra's algorithm on −log M [MT02 5.2.1, eq. 5]: any number of states, none twice. From a
/// state to itself: that state alone. Throws InvalidInput when there is none, naming what can be reached.
Path best_path(const TransitionMatrix& transitions, int from, int to);
/// The `count` best different ones, best first, none with a state twice (Yen's algorithm); fewer when there are no
/// more.
std::vector<Path> best_paths(const TransitionMatrix& transitions, int from, int to, int count);

/// Best path of exactly `length` ≥ 1 states, ends included, by dynamic programming [MT02 5.2.2]; states may come again,
/// and follow themselves where M_ii > 0. O(length · transitions). Throws InvalidInput when there is none, naming
/// possible lengths or what can be reached.
Path best_path_of_length(const TransitionMatrix& transitions, int from, int to, int length);
/// The `count` best different ones, best first; fewer when there are no more.
std::vector<Path> best_paths_of_length(const TransitionMatrix& transitions, int from, int to, int length, int count);

/// Repeats every state of a path by its self-transition probability [MT02 5.2.1]: once more while a draw of probability
/// M_ii succeeds, at most max_repeats more times.
std::vector<int> repeat_by_self_transition(std::span<const int> path, const TransitionMatrix& transitions, Rng& rng,
                                           int max_repeats = 20);

/// Σ log M over consecutive states; −∞ when one is impossible.
double path_log_prob(const TransitionMatrix& transitions, std::span<const int> states);

}  // namespace motex
