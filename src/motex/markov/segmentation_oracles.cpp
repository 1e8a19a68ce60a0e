// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/markov/segmentation_oracles.h"

#include <algorithm>

namespace motex {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();

// T × N (or T): best score of 0 … t, and how it was reached.
struct Reached {
  double score = kImpossible;
  int state = -1;
  Index start = -1;
  int predecessor = -1;
};

// Calls visit(end frame, score) for the segments of `state` from b, given the score of what lies before b.
template <typename Visit>
void for_each_end(const SegmentationInput& input, Index b, int state, double before, Visit&& visit) {
  const SegmentOptions& options = input.options;
  const Index T = input.emissions.rows();
  const Index shortest = std::min(options.min_length, T);
  const Index last = options.max_length > 0 ? std::min(T, b + options.max_length) : T;
  double score = before + (input.start_log_density.empty() ? 0 : input.start_log_density[static_cast<std::size_t>(b)]);
  if (input.state_start_log_density.size() > 0) score += static_cast<double>(input.state_start_log_density(b, state));
  for (Index t = b; t < last; ++t) {
    if (t >= b + options.num_start_frames) score += static_cast<double>(input.emissions(t, state));
    if (t - b + 1 >= shortest) visit(t, score);
  }
}

Matrix log_matrix(const TransitionMatrix& transitions) {
  const int N = transitions.num_states();
  Matrix result(N, N);
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) result(i, j) = transitions.log_prob(i, j);
  }
  return result;
}

}  // namespace

SegmentationReport segment_brute_force(const SegmentationInput& input) {
  check_segmentation_input(input);
  const Index T = input.emissions.rows();
  const auto N = static_cast<int>(input.emissions.cols());
  const Matrix log_m = log_matrix(input.transitions);
  std::vector<Reached> best(static_cast<std::size_t>(T * N));
  const auto at = [&](Index t, int i) -> Reached& { return best[static_cast<std::size_t>(t * N + i)]; };
  for (Index b = 0; b < T; ++b) {
    for (int i = 0; i < N; ++i) {
      double before = b == 0 ? 0 : kImpossible;
      int predecessor = -1;
      for (int l = 0; b > 0 && l < N; ++l) {
        const double end = at(b - 1, l).score + log_m(l, i);
        if (end > before) before = end, predecessor = l;
      }
      for_each_end(input, b, i, before, [&](Index t, double score) {
        if (score > at(t, i).score) at(t, i) = {score, i, b, predecessor};
      });
    }
  }
  SegmentationReport report;
  int state = 0;
  for (int i = 1; i < N; ++i) state = at(T - 1, i).score > at(T - 1, state).score ? i : state;
  report.score = at(T - 1, state).score;
  for (Index end = T; report.score > kImpossible && end > 0;) {
    const Reached& last = at(end - 1, state);
    report.segments.push_back({state, last.start, end - last.start});
    end = last.start;
    state = last.predecessor;
  }
  std::reverse(report.segments.begin(), report.segments.end());
  return report;
}

SegmentationReport segment_one_label(const SegmentationInput& input) {
  check_segmentation_input(input);
  const Index T = input.emissions.rows();
  const auto N = static_cast<int>(input.emissions.cols());
  const Matrix log_m = log_matrix(input.transitions);
  const Index most = std::max<Index>(1, T / input.options.min_length);
  std::vector<std::vector<Reached>> best(static_cast<std::size_t>(most),
                                         std::vector<Reached>(static_cast<std::size_t>(T)));  // (n − 1, t)
  for (std::size_t n = 0; n < best.size(); ++n) {
    const Index last_start = n == 0 ? 0 : T - 1;
    for (Index b = n == 0 ? 0 : 1; b <= last_start; ++b) {
      const Reached* before = n == 0 ? nullptr : &best[n - 1][static_cast<std::size_t>(b - 1)];
      if (before != nullptr && before->score == kImpossible) continue;
      for (int i = 0; i < N; ++i) {
        for_each_end(input, b, i, before == nullptr ? 0 : before->score + log_m(before->state, i),
                     [&](Index t, double score) {
                       Reached& reached = best[n][static_cast<std::size_t>(t)];
                       if (score > reached.score) reached = {score, i, b, -1};
                     });
      }
    }
  }
  SegmentationReport report;
  std::size_t n = 0;
  for (std::size_t k = 1; k < best.size(); ++k) n = best[k].back().score > best[n].back().score ? k : n;
  report.score = best[n].back().score;
  for (Index end = T; report.score > kImpossible && end > 0; --n) {
    const Reached& last = best[n][static_cast<std::size_t>(end - 1)];
    report.segments.push_back({last.state, last.start, end - last.start});
    end = last.start;
  }
  std::reverse(report.segments.begin(), report.segments.end());
  return report;
}

}  // namespace motex
