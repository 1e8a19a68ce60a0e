// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include "motex/lds/bridge.h"
#include "motex/lds/synthetic.h"

namespace {

using motex::FrameMatrix;
using motex::Index;

struct Ends {
  motex::Rng rng{1};
  motex::Lds lds;
  FrameMatrix states, noise;

  Ends(Index length, Index state_size) : lds(motex::random_lds(rng, state_size)) {
    states = motex::sample_states(lds, rng, length);
    noise.resize(length - 2, state_size);
    for (Index i = 0; i < noise.size(); ++i) noise.data()[i] = rng.normal();
  }
};

// A texton between key poses. Wanted: at most 0.3 ms. Known: the paper 25-35 ms; 0.3-0.9 ms.
void constrained_texton(benchmark::State& state) {
  Ends ends(state.range(0), state.range(1));
  motex::Bridge bridge(ends.lds);
  bridge.solve(ends.states, ends.noise);  // keeps the factor
  for (auto _ : state) {
    bridge.solve(ends.states, ends.noise);
    benchmark::DoNotOptimize(ends.states.data());
  }
}
BENCHMARK(constrained_texton)
    ->ArgNames({"frames", "state_size"})
    ->ArgsProduct({{60, 120, 172}, {15, 30}})
    ->Unit(benchmark::kMillisecond);

// The same when the length is new: with doubling and factorisation.
void constrained_texton_new_length(benchmark::State& state) {
  Ends ends(state.range(0), state.range(1));
  for (auto _ : state) {
    motex::Bridge bridge(ends.lds);
    bridge.solve(ends.states, ends.noise);
    benchmark::DoNotOptimize(ends.states.data());
  }
}
BENCHMARK(constrained_texton_new_length)
    ->ArgNames({"frames", "state_size"})
    ->ArgsProduct({{60, 172}, {15, 30}})
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
