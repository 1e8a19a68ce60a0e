// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/markov/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "motex/core/error.h"

namespace motex {
namespace {

TransitionMatrix random_matrix(Rng& rng, int num_states, double prior_count) {
  TransitionMatrix result(num_states, prior_count);
  const auto n = static_cast<std::uint64_t>(num_states);
  for (int k = 0; k < 2 * num_states; ++k) {
    const int from = static_cast<int>(rng.below(n)), to = static_cast<int>(rng.below(n));
    result.add_count(from, to, rng.uniform(0.1, 4));
  }
  return result;
}

// Every path from → to of at most (or exactly) `length` states with positive probability, best first.
std::vector<Path> all_paths(const TransitionMatrix& matrix, int from, int to, int length, bool exactly) {
  std::vector<Path> found;
  std::vector<int> states = {from};
  const std::function<void()> extend = [&] {
    const bool long_enough = !exactly || static_cast<int>(states.size()) == length;
    if (states.back() == to && long_enough) found.push_back({states, path_log_prob(matrix, states)});
    if (static_cast<int>(states.size()) == length || (!exactly && states.back() == to)) return;
    for (int next = 0; next < matrix.num_states(); ++next) {
      const bool seen = std::find(states.begin(), states.end(), next) != states.end();
      if (matrix.probability(states.back(), next) == 0 || (!exactly && seen)) continue;
      states.push_back(next);
      extend();
      states.pop_back();
    }
  };
  extend();
  std::stable_sort(found.begin(), found.end(), [](const Path& a, const Path& b) { return a.log_prob > b.log_prob; });
  return found;
}

void expect_same_paths(const std::vector<Path>& paths, const std::vector<Path>& expected, std::size_t count) {
  ASSERT_EQ(paths.size(), std::min(count, expected.size()));
  for (std::size_t k = 0; k < paths.size(); ++k) EXPECT_NEAR(paths[k].log_prob, expected[k].log_prob, 1e-12);
  for (std::size_t k = 0; k < paths.size(); ++k) {
    for (std::size_t l = 0; l < k; ++l) EXPECT_NE(paths[k].states, paths[l].states);
  }
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

// 0 → 1 → 2 → 1, 0 → 3 (a dead end), 4 alone
TransitionMatrix small_chain() {
  TransitionMatrix matrix(5);
  matrix.add_count(0, 1, 3);
  matrix.add_count(0, 3, 1);
  matrix.add_count(1, 2);
  matrix.add_count(2, 1);
  return matrix;
}

TEST(Paths, SayWhatCanBeReached) {
  const auto matrix = small_chain();
  EXPECT_EQ(message_of([&] { best_path(matrix, 1, 4); }),
            "there is no path from state 1 to state 4; from state 1 one reaches 1, 2");
  EXPECT_EQ(message_of([&] { best_path(matrix, 3, 0); }),
            "there is no path from state 3 to state 0; state 3 has no successor");
  EXPECT_EQ(message_of([&] { best_path_of_length(matrix, 0, 2, 6); }),
            "there is no path of 6 states from state 0 to state 2; the nearest possible: 5 and 7");
  EXPECT_EQ(message_of([&] { best_path_of_length(matrix, 0, 4, 6); }),
            "there is no path from state 0 to state 4; from state 0 one reaches 1, 2, 3");
  EXPECT_THROW(best_path(matrix, 0, 5), InvalidInput);
  EXPECT_THROW(best_path_of_length(matrix, 0, 1, 0), InvalidInput);
  EXPECT_THROW(best_paths(matrix, 0, 1, 0), InvalidInput);
}

TEST(Paths, FromAStateToItselfIsThatState) {
  const auto matrix = small_chain();
  EXPECT_EQ(best_path(matrix, 1, 1).states, std::vector<int>{1});
  EXPECT_EQ(best_paths(matrix, 1, 1, 3).size(), 1U);
  EXPECT_EQ(best_path_of_length(matrix, 1, 1, 3).states, (std::vector<int>{1, 2, 1}));
}

TEST(Paths, BestAndRunnersUpAgreeWithAllPaths) {
  Rng rng(1);
  int num_pairs = 0;
  for (int round = 0; round < 60; ++round) {
    const auto matrix = random_matrix(rng, 6, round % 3 == 0 ? 0.7 : 0.0);
    for (int to = 1; to < 6; ++to) {
      const auto expected = all_paths(matrix, 0, to, 6, false);
      if (expected.empty()) {
        EXPECT_THROW(best_path(matrix, 0, to), InvalidInput);
        continue;
      }
      ++num_pairs;
      EXPECT_NEAR(best_path(matrix, 0, to).log_prob, expected.front().log_prob, 1e-12);
      expect_same_paths(best_paths(matrix, 0, to, 7), expected, 7);
    }
  }
  EXPECT_GT(num_pairs, 100);
}

TEST(Paths, OfExactLengthAgreeWithAllPaths) {
  Rng rng(2);
  int num_pairs = 0;
  for (int round = 0; round < 40; ++round) {
    const auto matrix = random_matrix(rng, 5, round % 3 == 0 ? 0.7 : 0.0);
    for (int length = 1; length <= 5; ++length) {
      const auto expected = all_paths(matrix, 0, 3, length, true);
      if (expected.empty()) {
        EXPECT_THROW(best_path_of_length(matrix, 0, 3, length), InvalidInput);
        continue;
      }
      ++num_pairs;
      const auto paths = best_paths_of_length(matrix, 0, 3, length, 4);
      expect_same_paths(paths, expected, 4);
      for (const auto& path : paths) EXPECT_EQ(path.states.size(), static_cast<std::size_t>(length));
    }
  }
  EXPECT_GT(num_pairs, 60);
}

TEST(SamplePath, FollowsTheProbabilities) {
  for (const double prior : {0.0, 2.0}) {
    TransitionMatrix matrix(3, prior);
    matrix.add_count(0, 0, 1);
    matrix.add_count(0, 1, 3);
    matrix.add_count(1, 0);
    matrix.add_count(2, 0);
    Rng rng(5);
    const int length = 60000;
    const auto path = sample_path(matrix, 0, length, rng);
    ASSERT_EQ(path.states.size(), static_cast<std::size_t>(length));
    TransitionMatrix seen(3);
    seen.add_sequence(path.states);
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(seen.probability(0, j), matrix.probability(0, j), 0.01);
    EXPECT_NEAR(path.log_prob, path_log_prob(matrix, path.states), 1e-9);
  }
}

TEST(SamplePath, SameSeedSamePathAndDeadEndsAreSaid) {
  Rng seed(9);
  const auto matrix = random_matrix(seed, 8, 1);
  Rng a(4), b(4);
  EXPECT_EQ(sample_path(matrix, 2, 500, a).states, sample_path(matrix, 2, 500, b).states);
  TransitionMatrix chain(3);
  chain.add_count(0, 1);
  chain.add_count(1, 2);
  EXPECT_NE(message_of([&] { sample_path(chain, 0, 9, a); }).find("state 2, a dead end, after 3 of 9"),
            std::string::npos);
  EXPECT_THROW(sample_next(chain, 2, a), InvalidInput);
  EXPECT_EQ(sample_path(chain, 0, 3, a).states, (std::vector<int>{0, 1, 2}));
}

TEST(RepeatBySelfTransition, RepeatsGeometrically) {
  TransitionMatrix matrix(3);
  matrix.add_count(0, 0, 3);
  matrix.add_count(0, 1, 1);
  matrix.add_count(1, 2);
  matrix.add_count(2, 2);
  Rng rng(6);
  const std::vector<int> path = {0, 1, 2};
  double sum = 0;
  for (int k = 0; k < 20000; ++k) {
    const auto repeated = repeat_by_self_transition(path, matrix, rng, 50);
    EXPECT_EQ(std::count(repeated.begin(), repeated.end(), 1), 1);
    EXPECT_EQ(std::count(repeated.begin(), repeated.end(), 2), 51);  // never leaves: the limit
    sum += static_cast<double>(std::count(repeated.begin(), repeated.end(), 0));
  }
  EXPECT_NEAR(sum / 20000, 1 / (1 - 0.75), 0.1);
}

}  // namespace
}  // namespace motex
