// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Motifs against known truth: series in which actions are planted between idle frames (sway and noise), ten seeds of
// each variant: recall and precision (a performance is found when a motif of its class begins at most half a window
// away), with the window told and not told.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>

#include "bench/quality/planted_actions.h"
#include "motex/people/motifs.h"

namespace motex {
namespace {

constexpr int kSeeds = 10;

struct Score {
  int right = 0, found = 0, planted = 0, motifs = 0;
};

void add(Score& score, const bench::Planted& planted, const MotifSet& set, int window) {
  std::vector<bool> used(planted.truth.size());
  score.planted += static_cast<int>(used.size());
  score.motifs += static_cast<int>(set.motifs.size());
  for (const Motif& motif : set.motifs) {
    std::map<int, int> votes;
    const auto near = [&](const Occurrence& o, std::size_t k) {
      return std::abs(o.start - planted.truth[k].first) <= window / 2;
    };
    for (const Occurrence& o : motif.occurrences)
      for (std::size_t k = 0; k < used.size(); ++k)
        if (near(o, k)) ++votes[planted.truth[k].second];
    int kind = -1;
    for (const auto& [candidate, count] : votes)
      if (kind < 0 || count > votes[kind]) kind = candidate;
    for (const Occurrence& o : motif.occurrences) {
      ++score.found;
      for (std::size_t k = 0; k < used.size(); ++k)
        if (!used[k] && planted.truth[k].second == kind && near(o, k)) {
          used[k] = true;
          ++score.right;
          break;
        }
    }
  }
}

void measure(const bench::Variant& variant) {
  for (const bool told : {true, false}) {
    Score score;
    const std::clock_t begin = std::clock();
    for (int seed = 1; seed <= kSeeds; ++seed) {
      const bench::Planted planted = bench::plant(variant, static_cast<std::uint64_t>(seed));
      FindMotifsOptions options;
      options.window = told ? variant.window : 0;
      add(score, planted, find_motifs(planted.series, options).set, variant.window);
    }
    std::printf("%-24s window %-4s recall %.3f precision %.3f motifs %.1f (%d planted) %.2f s of processor a series\n",
                variant.name, told ? "told" : "any", static_cast<double>(score.right) / score.planted,
                score.found > 0 ? static_cast<double>(score.right) / score.found : 1.0,
                static_cast<double>(score.motifs) / kSeeds, variant.classes,
                static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / kSeeds);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace motex

int main() {
  for (const motex::bench::Variant& variant :
       {motex::bench::Variant{"4 x 5", 4, 5, 80, 0.05, 0.012},
        motex::bench::Variant{"warp 10 %", 4, 5, 80, 0.10, 0.012},
        motex::bench::Variant{"noise doubled", 4, 5, 80, 0.05, 0.024},
        motex::bench::Variant{"6 x 3", 6, 3, 80, 0.05, 0.012}, motex::bench::Variant{"3 x 8", 3, 8, 80, 0.05, 0.012},
        motex::bench::Variant{"40 frames", 4, 5, 40, 0.05, 0.012},
        motex::bench::Variant{"160 frames", 4, 5, 160, 0.05, 0.012}})
    motex::measure(variant);
  return 0;
}
