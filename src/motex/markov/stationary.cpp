// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/markov/stationary.h"

#include <numeric>

#include "motex/core/error.h"
#include "motex/core/matrix.h"
#include "motex/markov/graph.h"

namespace motex {
namespace {

Matrix dense_rows(const TransitionMatrix& transitions, std::span<const int> states) {
  const auto n = static_cast<Index>(states.size());
  Matrix p(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      p(i, j) = transitions.count(states[static_cast<std::size_t>(i)], states[static_cast<std::size_t>(j)]);
  for (Index i = 0; i < n; ++i) p.row(i) /= p.row(i).sum();
  return p;
}

}  // namespace

std::vector<double> stationary_shares(const TransitionMatrix& transitions, std::span<const int> states) {
  if (states.empty()) throw InvalidInput("a chain without states has no stationary distribution");
  const TransitionMatrix among = transitions.restricted_to(states);
  const Components components = strongly_connected_components(counted_graph(among));
  for (const int state : states)
    if (components.component_of[static_cast<std::size_t>(state)] !=
            components.component_of[static_cast<std::size_t>(states[0])] ||
        among.is_dead_end(state))
      throw InvalidInput("state " + std::to_string(state) + " is not reached again from all others");
  Matrix p = dense_rows(among, states);
  const Index n = p.rows();
  for (Index k = n - 1; k > 0; --k) {  // the chain watched only while it is in states 0 … k − 1
    p.col(k).head(k) /= p.row(k).head(k).sum();
    p.topLeftCorner(k, k).noalias() += p.col(k).head(k) * p.row(k).head(k);
  }
  std::vector<double> shares(states.size(), 1);
  for (Index k = 1; k < n; ++k) {
    double sum = 0;
    for (Index i = 0; i < k; ++i) sum += shares[static_cast<std::size_t>(i)] * p(i, k);
    shares[static_cast<std::size_t>(k)] = sum;
  }
  const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= total;
  return shares;
}

}  // namespace motex
