// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// The paper's mode of motif search against the exact one: random projection's closest pair over the exact closest pair,
// on planted series and on the aspect ratio of simulated actors, ten seeds each.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>

#include "bench/quality/planted_actions.h"
#include "bench/simulated_people.h"
#include "motex/core/quantile.h"
#include "motex/people/footage_motifs.h"
#include "motex/people/matrix_profile.h"
#include "motex/people/random_projection.h"

namespace motex {
namespace {

constexpr int kSeeds = 10;

/// The closest pair of random projection over the exact closest pair, for the paper's windows: of the cell of most
/// collisions alone, of the cells that are compared, as they stand, and after the search around the closest of them.
void measure_projection(const char* name, const std::function<FrameMatrix(std::uint64_t)>& series_of_seed) {
  for (const int window : {40, 80, 160}) {
    std::vector<double> top, cells, searched;
    double compared = 0, secs = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const SeriesWindows windows = series_windows(series_of_seed(seed), window);
      const MatrixProfile profile = matrix_profile(windows, window - 1);
      const double exact = *std::min_element(profile.distance.begin(), profile.distance.end());
      const double unit = exact / std::sqrt(static_cast<double>(window));
      RandomProjectionOptions options;
      options.seed = seed;
      const std::clock_t begin = std::clock();
      const RandomProjectionReport report = random_projection_motifs(windows, options);
      secs += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
      const std::vector<Collision>& all = report.collisions.back().cells;
      const Collision most = *std::max_element(
          all.begin(), all.end(), [](const Collision& a, const Collision& b) { return a.count < b.count; });
      top.push_back(windows.distance(most.row, most.column) / exact);
      cells.push_back(report.in_matrix.distance / unit);
      searched.push_back(report.closest.distance / unit);
      compared += report.num_compared;
    }
    std::printf(
        "%s, %3d frames: found / exact, median and worst of %d: cell of most collisions %.3f %.3f, cells "
        "compared %.3f %.3f, after the search around them %.3f %.3f; %.0f pairs compared, %.2f s of processor\n",
        name, window, kSeeds, median(top), *std::max_element(top.begin(), top.end()), median(cells),
        *std::max_element(cells.begin(), cells.end()), median(searched),
        *std::max_element(searched.begin(), searched.end()), compared / kSeeds, secs / kSeeds);
    std::fflush(stdout);
  }
}

FrameMatrix actor_aspect(std::uint64_t seed) {
  SimulateActorOptions options;
  options.width = 360, options.height = 240, options.frames = 3000, options.seed = seed;
  const PeopleTexture texture = bench::texture_of(ActorSimulation(options), options);
  return motif_series(paper_motif_signals(texture));
}

}  // namespace
}  // namespace motex

int main() {
  motex::measure_projection("planted, 9,000 frames", [](std::uint64_t seed) {
    return motex::bench::plant({"", 4, 5, 80, 0.05, 0.012}, seed).series;
  });
  motex::measure_projection("simulated actor's aspect, 3,000 frames", motex::actor_aspect);
  return 0;
}
