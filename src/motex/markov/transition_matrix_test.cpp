// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/markov/transition_matrix.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TransitionMatrix random_matrix(Rng& rng, int num_states, double prior_count) {
  TransitionMatrix result(num_states, prior_count);
  const auto n = static_cast<std::uint64_t>(num_states);
  for (int k = 0; k < 3 * num_states; ++k) {
    const int from = static_cast<int>(rng.below(n)), to = static_cast<int>(rng.below(n));
    result.add_count(from, to, rng.uniform(0.1, 4));
  }
  return result;
}

TEST(TransitionMatrix, RefusesNonsense) {
  EXPECT_THROW(TransitionMatrix(-1), InvalidInput);
  EXPECT_THROW(TransitionMatrix(3, -0.5), InvalidInput);
  EXPECT_THROW(TransitionMatrix(3, NAN), InvalidInput);
  TransitionMatrix matrix(3);
  EXPECT_THROW(matrix.add_count(0, 3), InvalidInput);
  EXPECT_THROW(matrix.add_count(-1, 0), InvalidInput);
  EXPECT_THROW(matrix.add_count(0, 0, -1), InvalidInput);
  EXPECT_THROW(matrix.add_count(0, 0, kInfinity), InvalidInput);
  EXPECT_THROW(matrix.add_sequence(std::vector<int>{7}), InvalidInput);
  EXPECT_THROW(matrix.probability(3, 0), InvalidInput);
}

TEST(TransitionMatrix, CountsWithinSequencesOnly) {
  const std::vector<std::vector<int>> sequences = {{0, 1, 0, 1}, {}, {2}, {2, 2, 0}};
  const auto matrix = TransitionMatrix::from_sequences(3, sequences);
  EXPECT_EQ(matrix.count(0, 1), 2);
  EXPECT_EQ(matrix.count(1, 0), 1);
  EXPECT_EQ(matrix.count(1, 2), 0);  // not from the end of one to the start of the next
  EXPECT_EQ(matrix.count(2, 2), 1);
  EXPECT_DOUBLE_EQ(matrix.probability(2, 0), 0.5);
  EXPECT_EQ(matrix.counts().size(), 4U);
}

TEST(TransitionMatrix, WithoutPriorARowWithoutCountsIsADeadEnd) {
  TransitionMatrix matrix(2);
  matrix.add_count(0, 1);
  EXPECT_FALSE(matrix.is_dead_end(0));
  EXPECT_TRUE(matrix.is_dead_end(1));
  EXPECT_EQ(matrix.probability(1, 0), 0);
  EXPECT_EQ(matrix.log_prob(0, 0), -kInfinity);
  EXPECT_EQ(matrix.log_prob(0, 1), 0);
  matrix.set_prior_count(1);
  EXPECT_FALSE(matrix.is_dead_end(1));
  EXPECT_DOUBLE_EQ(matrix.probability(1, 0), 0.5);
  EXPECT_DOUBLE_EQ(matrix.probability(0, 1), 0.75);
}

TEST(TransitionMatrix, RowsSumToOneAndSparseFormAgrees) {
  Rng rng(2);
  for (const double prior : {0.0, 0.01, 1.0, 50.0}) {
    const auto matrix = random_matrix(rng, 12, prior);
    const auto sparse = matrix.log_transitions();
    for (int i = 0; i < 12; ++i) {
      double sum = 0;
      std::vector<double> row(12, sparse.base[static_cast<std::size_t>(i)]);
      for (const auto& entry : sparse.row(i)) {
        EXPECT_GE(entry.log_prob, sparse.base[static_cast<std::size_t>(i)]);
        row[static_cast<std::size_t>(entry.to)] = entry.log_prob;
      }
      for (int j = 0; j < 12; ++j) {
        sum += matrix.probability(i, j);
        EXPECT_EQ(row[static_cast<std::size_t>(j)], matrix.log_prob(i, j));
      }
      EXPECT_NEAR(sum, matrix.is_dead_end(i) ? 0 : 1, 1e-12);
    }
  }
}

TEST(TransitionMatrix, ProbabilitiesMaximiseLikelihoodTimesPrior) {
  Rng rng(4);
  const double prior = 1.5;
  const auto matrix = random_matrix(rng, 6, prior);
  double objective = 0;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) objective += (matrix.count(i, j) + prior / 6) * matrix.log_prob(i, j);
  }
  EXPECT_NEAR(matrix.log_likelihood() + matrix.log_prior(), objective, 1e-10);
  for (int k = 0; k < 20; ++k) {  // the same counts scored by other rows
    const auto other = random_matrix(rng, 6, prior);
    double worse = other.log_prior();
    for (const auto& entry : matrix.counts()) worse += entry.count * other.log_prob(entry.from, entry.to);
    EXPECT_LT(worse, objective);
  }
  EXPECT_EQ(TransitionMatrix(5).log_prior(), 0);
}

TEST(TransitionMatrix, RestrictionKeepsCountsInside) {
  Rng rng(8);
  const auto matrix = random_matrix(rng, 9, 2);
  const std::vector<int> kept = {1, 4, 5, 8};
  const auto inside = matrix.restricted_to(kept);
  EXPECT_EQ(inside.prior_count(), 0);
  const auto is_kept = [&](int i) { return std::find(kept.begin(), kept.end(), i) != kept.end(); };
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) EXPECT_EQ(inside.count(i, j), is_kept(i) && is_kept(j) ? matrix.count(i, j) : 0);
  }
}

}  // namespace
}  // namespace motex
