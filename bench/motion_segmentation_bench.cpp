// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <numeric>
#include <utility>

#include "motex/core/rng.h"
#include "motex/markov/segmentation.h"

namespace {

using motex::FrameMatrixF;
using motex::Index;

// 3,000 frames of a label that changes about every second, and a chain with few counts as learned from one dance.
struct Dance {
  FrameMatrixF emissions;
  std::vector<double> start;
  motex::TransitionMatrix transitions;

  explicit Dance(Index states, double prior_count)
      : emissions(3000, states), start(3000, -70.0), transitions(static_cast<int>(states), prior_count) {
    motex::Rng rng(1);
    const auto n = static_cast<std::uint64_t>(states);
    Index label = 0;
    for (Index t = 0; t < emissions.rows(); ++t) {
      if (rng.uniform() < 1.0 / 70) {
        const auto next = static_cast<Index>(rng.below(n));
        transitions.add_count(static_cast<int>(label), static_cast<int>(next));
        label = next;
      }
      for (Index i = 0; i < states; ++i) {
        emissions(t, i) = static_cast<float>(-60 + 8 * rng.normal() + (i == label ? 8 : 0));
      }
    }
    for (Index k = 0; k < 3 * states; ++k) {
      transitions.add_count(static_cast<int>(rng.below(n)), static_cast<int>(rng.below(n)));
    }
  }
};

// Arguments: states, T_max, prior count.
void segment_sequence(benchmark::State& state) {
  const Dance dance(state.range(0), static_cast<double>(state.range(2)));
  const motex::SegmentOptions options{60, state.range(1), 2};
  for (auto _ : state) {
    const motex::SegmentationInput input{dance.emissions, dance.start, dance.transitions, options};
    benchmark::DoNotOptimize(motex::segment_sequence(input).score);
  }
  state.counters["secs_per_cell"] =
      benchmark::Counter(3000.0 * static_cast<double>(state.range(0)),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(segment_sequence)
    ->ArgNames({"states", "max_length", "prior"})
    ->Args({334, 0, 1})
    ->Args({334, 250, 1})
    ->Args({334, 0, 0})
    ->Args({334, 250, 0})
    ->Args({64, 250, 1})
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
