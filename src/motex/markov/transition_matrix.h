// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace motex {

/// n_ij > 0.
struct TransitionCount {
  int from = 0;
  int to = 0;
  double count = 0;
};

/// log p_ij = base[i], except where (i, j) is listed. Listed values are never below the base of their row.
struct LogTransitions {
  struct Entry {
    int to = 0;
    double log_prob = 0;
  };
  std::vector<double> base;            ///< N; −∞ where the row has no prior
  std::vector<std::size_t> row_begin;  ///< N + 1: row i is entries[row_begin[i]] … entries[row_begin[i + 1] − 1]
  std::vector<Entry> entries;          ///< within a row by rising `to`

  int num_states() const { return static_cast<int>(base.size()); }
  std::span<const Entry> row(int from) const {
    const auto i = static_cast<std::size_t>(from);
    return std::span(entries).subspan(row_begin[i], row_begin[i + 1] - row_begin[i]);
  }
};

/// First-order Markov chain over N states, kept as counts n_ij ≥ 0 with a symmetric Dirichlet prior on every row:
///
///   p_ij = (n_ij + α/N) / (n_i + α),   n_i = Σ_j n_ij
///
/// the posterior mean under Dirichlet(α/N), which is the posterior mode under Dirichlet(1 + α/N). α = prior_count = 0
/// is the maximum-likelihood chain [MT02 4: M_ij]; there a row without counts is a dead end, p_ij = 0 for all j. Only
/// counts that were added take memory. Arguments out of range, negative or not finite: InvalidInput.
class TransitionMatrix {
 public:
  TransitionMatrix() = default;
  explicit TransitionMatrix(int num_states, double prior_count = 0);
  /// Counts neighbours within each sequence; none crosses from one to the next.
  static TransitionMatrix from_sequences(int num_states, std::span<const std::vector<int>> sequences,
                                         double prior_count = 0);

  void add_count(int from, int to, double weight = 1);
  void add_sequence(std::span<const int> labels, double weight = 1);
  void set_prior_count(double prior_count);

  int num_states() const { return static_cast<int>(rows_.size()); }
  double prior_count() const { return prior_count_; }
  double count(int from, int to) const;
  double row_count(int from) const;
  double probability(int from, int to) const;
  double log_prob(int from, int to) const;
  /// log p_ij of a transition that was never counted; −∞ when α = 0.
  double base_log_prob(int from) const;
  bool is_dead_end(int from) const;

  /// Entries with a positive count by rising `from`, then `to`; and those of one row.
  std::vector<TransitionCount> counts() const;
  std::span<const TransitionCount> counts_from(int from) const;
  LogTransitions log_transitions() const;

  /// Σ_ij n_ij log p_ij: of the counted transitions under this matrix.
  double log_likelihood() const;
  /// Σ_ij (α/N) log p_ij: log Dirichlet(1 + α/N) density of all rows without its normalising constant, which depends on
  /// N and α alone. log_likelihood() + log_prior() is largest at exactly these p, so an objective with this term does
  /// not fall when the counts are renewed.
  double log_prior() const;

  /// The same states, counts only between the listed ones, and no prior: what a walk kept inside a component uses.
  TransitionMatrix restricted_to(std::span<const int> states) const;

 private:
  void check_state(int state) const;

  double prior_count_ = 0;
  std::vector<std::vector<TransitionCount>> rows_;  // by rising `to`
  std::vector<double> row_counts_;
};

}  // namespace motex
