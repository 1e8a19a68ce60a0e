// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/markov/transition_matrix.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

void check_weight(double value, const char* what) {
  if (!(value >= 0) || !std::isfinite(value)) {
    throw InvalidInput("transition matrix: " + std::string(what) + " is " + std::to_string(value) +
                       "; give a finite number that is not negative");
  }
}

bool is_before(const TransitionCount& entry, int to) { return entry.to < to; }

}  // namespace

TransitionMatrix::TransitionMatrix(int num_states, double prior_count) {
  if (num_states < 0) throw InvalidInput("transition matrix: the number of states is negative");
  set_prior_count(prior_count);
  rows_.resize(static_cast<std::size_t>(num_states));
  row_counts_.resize(static_cast<std::size_t>(num_states));
}

TransitionMatrix TransitionMatrix::from_sequences(int num_states, std::span<const std::vector<int>> sequences,
                                                  double prior_count) {
  TransitionMatrix result(num_states, prior_count);
  for (const auto& labels : sequences) result.add_sequence(labels);
  return result;
}

void TransitionMatrix::check_state(int state) const {
  if (state < 0 || state >= num_states()) {
    throw InvalidInput("transition matrix: there is no state " + std::to_string(state) + "; states are 0 … " +
                       std::to_string(num_states() - 1));
  }
}

void TransitionMatrix::add_count(int from, int to, double weight) {
  check_state(from);
  check_state(to);
  check_weight(weight, "a count");
  if (weight == 0) return;
  auto& row = rows_[static_cast<std::size_t>(from)];
  auto place = std::lower_bound(row.begin(), row.end(), to, is_before);
  if (place == row.end() || place->to != to) place = row.insert(place, TransitionCount{from, to, 0});
  place->count += weight;
  row_counts_[static_cast<std::size_t>(from)] += weight;
}

void TransitionMatrix::add_sequence(std::span<const int> labels, double weight) {
  if (labels.size() == 1) check_state(labels[0]);
  for (std::size_t k = 1; k < labels.size(); ++k) add_count(labels[k - 1], labels[k], weight);
}

void TransitionMatrix::set_prior_count(double prior_count) {
  check_weight(prior_count, "the prior count");
  prior_count_ = prior_count;
}

double TransitionMatrix::count(int from, int to) const {
  check_state(from);
  check_state(to);
  const auto& row = rows_[static_cast<std::size_t>(from)];
  const auto place = std::lower_bound(row.begin(), row.end(), to, is_before);
  return place == row.end() || place->to != to ? 0 : place->count;
}

double TransitionMatrix::row_count(int from) const {
  check_state(from);
  return row_counts_[static_cast<std::size_t>(from)];
}

double TransitionMatrix::probability(int from, int to) const {
  const double total = row_count(from) + prior_count_;
  return total > 0 ? (count(from, to) + prior_count_ / num_states()) / total : 0;
}

double TransitionMatrix::log_prob(int from, int to) const {
  const double p = probability(from, to);
  return p > 0 ? std::log(p) : kImpossible;
}

double TransitionMatrix::base_log_prob(int from) const {
  const double total = row_count(from) + prior_count_;
  return prior_count_ > 0 ? std::log(prior_count_ / num_states() / total) : kImpossible;
}

bool TransitionMatrix::is_dead_end(int from) const { return row_count(from) + prior_count_ <= 0; }

std::vector<TransitionCount> TransitionMatrix::counts() const {
  std::vector<TransitionCount> result;
  for (const auto& row : rows_) result.insert(result.end(), row.begin(), row.end());
  return result;
}

std::span<const TransitionCount> TransitionMatrix::counts_from(int from) const {
  check_state(from);
  return rows_[static_cast<std::size_t>(from)];
}

LogTransitions TransitionMatrix::log_transitions() const {
  LogTransitions result;
  result.row_begin.push_back(0);
  for (int i = 0; i < num_states(); ++i) {
    result.base.push_back(base_log_prob(i));
    for (const TransitionCount& e : rows_[static_cast<std::size_t>(i)]) {
      // A count far below the prior may round to less than the base; the promise of the header is kept here.
      result.entries.push_back({e.to, std::max(log_prob(i, e.to), result.base.back())});
    }
    result.row_begin.push_back(result.entries.size());
  }
  return result;
}

double TransitionMatrix::log_likelihood() const {
  double sum = 0;
  for (const auto& e : counts()) sum += e.count * log_prob(e.from, e.to);
  return sum;
}

double TransitionMatrix::log_prior() const {
  if (prior_count_ == 0) return 0;
  double sum = 0;
  for (int i = 0; i < num_states(); ++i) {
    const double base = base_log_prob(i);
    sum += base * num_states();
    for (const TransitionCount& e : rows_[static_cast<std::size_t>(i)]) sum += log_prob(i, e.to) - base;
  }
  return sum * prior_count_ / num_states();
}

TransitionMatrix TransitionMatrix::restricted_to(std::span<const int> states) const {
  std::vector<bool> kept(rows_.size(), false);
  for (const int state : states) {
    check_state(state);
    kept[static_cast<std::size_t>(state)] = true;
  }
  TransitionMatrix result(num_states());
  for (const auto& e : counts()) {
    if (kept[static_cast<std::size_t>(e.from)] && kept[static_cast<std::size_t>(e.to)]) {
      result.add_count(e.from, e.to, e.count);
    }
  }
  return result;
}

}  // namespace motex
