// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <cstdio>

#include "motex/core/error.h"
#include "motex/markov/graph.h"
#include "motex/markov/paths.h"

namespace {

enum Step : int { kStand, kWalk, kRun, kJump, kBow };
constexpr std::array<const char*, 5> kNames = {"stand", "walk", "run", "jump", "bow"};

void print(const char* title, const motex::Path& path) {
  std::printf("%-22s", title);
  for (const int state : path.states) std::printf(" %s", kNames[static_cast<std::size_t>(state)]);
  std::printf("   (probability %.4f)\n", std::exp(path.log_prob));
}

}  // namespace

int main() {
  // What followed what, in three performances; after the bow nothing did.
  const std::vector<std::vector<int>> performances = {
      {kStand, kWalk, kRun, kJump, kRun, kWalk, kStand, kBow},
      {kStand, kWalk, kWalk, kRun, kJump, kJump, kStand, kWalk, kStand, kBow},
      {kWalk, kRun, kRun, kJump, kStand, kBow}};
  const auto transitions = motex::TransitionMatrix::from_sequences(5, performances);

  print("best path:", motex::best_path(transitions, kWalk, kBow));
  print("runner-up:", motex::best_paths(transitions, kWalk, kBow, 2).back());
  print("best of seven steps:", motex::best_path_of_length(transitions, kWalk, kBow, 7));

  // Random steps without end stay where every step leads back to every other.
  const auto components = motex::strongly_connected_components(motex::counted_graph(transitions));
  motex::Rng rng(3);
  print("sampled:", motex::sample_path(transitions.restricted_to(components.largest()), kStand, 12, rng));
  try {
    motex::best_path(transitions, kBow, kWalk);
  } catch (const motex::InvalidInput& error) {
    std::printf("and back: %s\n", error.what());
    return 0;
  }
  return 1;
}
