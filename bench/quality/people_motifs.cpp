// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Motifs against known truth: series in which actions are planted between idle frames (sway and noise), ten seeds of
// each variant: recall and precision (a performance is found when a motif of its class begins at most half a window
// away), with the window told and not told; random projection's closest pair over the exact one; processor seconds of
// the exact matrix profile.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <numbers>

#include "motex/core/rng.h"
#include "motex/people/matrix_profile.h"
#include "motex/people/motifs.h"
#include "motex/people/random_projection.h"

namespace motex {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSeeds = 10;

struct Variant {
  const char* name;
  int classes, performances, window;
  double warp, noise;
};

struct Planted {
  FrameMatrix series;
  std::vector<std::pair<int, int>> truth;  // start, class
};

double action(int kind, double t) {
  const double bell = std::sin(kPi * t);
  switch (kind) {
    case 0:
      return 0.25 * bell * bell * std::sin(4 * kPi * t);
    case 1:
      return 0.35 * std::exp(-std::pow((t - 0.3) / 0.09, 2)) + 0.2 * std::exp(-std::pow((t - 0.7) / 0.12, 2));
    case 2:
      return 0.3 * std::max(0.0, 1 - std::abs(t - 0.5) * 4);
    case 3:
      return 0.28 * bell * std::sin(2 * kPi * (1 + 2 * t) * t);
    case 4:
      return -0.3 * bell * bell;
    default:
      return 0.3 * bell * (t < 0.5 ? -1 : 1) * std::abs(std::cos(kPi * t));
  }
}

Planted plant(const Variant& variant, std::uint64_t seed) {
  Rng rng(seed);
  const int total = variant.classes * variant.performances, gap = 5 * variant.window + 40;
  const int num_frames = 60 + total * gap + 200;
  std::vector<double> sway(static_cast<std::size_t>(num_frames), 0);
  double a = 0, b = 0, squares = 0;
  for (double& x : sway) {
    a = 0.95 * a + rng.normal();
    b = 0.95 * b + a;
    x = b;
    squares += b * b;
  }
  const double scale = 0.02 / std::sqrt(squares / num_frames);
  Planted out{FrameMatrix(num_frames, 1), {}};
  for (int t = 0; t < num_frames; ++t)
    out.series(t, 0) = 0.45 + scale * sway[static_cast<std::size_t>(t)] + variant.noise * rng.normal();
  std::vector<int> order;
  for (int k = 0; k < total; ++k) order.push_back(k % variant.classes);
  for (std::size_t k = order.size(); k-- > 1;) std::swap(order[k], order[rng.below(k + 1)]);
  for (int k = 0; k < total; ++k) {
    const int kind = order[static_cast<std::size_t>(k)];
    const int length = static_cast<int>(std::lround(variant.window * rng.uniform(1 - variant.warp, 1 + variant.warp)));
    const int start = 60 + k * gap + static_cast<int>(rng.below(60));
    const double strength = 1 + 0.1 * rng.normal();
    for (int t = 0; t < length; ++t) out.series(start + t, 0) += strength * action(kind, t / (length - 1.0));
    out.truth.emplace_back(start, kind);
  }
  return out;
}

struct Score {
  int right = 0, found = 0, planted = 0, motifs = 0;
};

void add(Score& score, const Planted& planted, const MotifSet& set, int window) {
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

void measure(const Variant& variant) {
  for (const bool told : {true, false}) {
    Score score;
    const std::clock_t begin = std::clock();
    for (int seed = 1; seed <= kSeeds; ++seed) {
      const Planted planted = plant(variant, static_cast<std::uint64_t>(seed));
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

void measure_projection() {
  double worst = 0;
  for (int seed = 1; seed <= kSeeds; ++seed)
    for (const int window : {40, 80, 160}) {
      const Planted planted = plant({"", 4, 5, 80, 0.05, 0.012}, static_cast<std::uint64_t>(seed));
      const SeriesWindows windows = series_windows(planted.series, window);
      const MatrixProfile profile = matrix_profile(windows, window - 1);
      const double exact = *std::min_element(profile.distance.begin(), profile.distance.end());
      worst = std::max(worst, random_projection_motifs(windows).distance * std::sqrt(window * 1.0) / exact);
    }
  std::printf("random projection, closest pair found / exact, worst of %d: %.3f\n", 3 * kSeeds, worst);
}

void measure_speed() {
  JobContext one;
  one.jobs = 1;
  for (const int num_frames : {9000, 100000}) {
    Rng rng(1);
    FrameMatrix x(num_frames, 1);
    double level = 0;
    for (Index t = 0; t < num_frames; ++t) x(t, 0) = level = 0.9 * level + rng.normal();
    const std::clock_t begin = std::clock();
    matrix_profile(series_windows(x, 80), -1, one);
    std::printf("exact profile, %d points, window 80: %.3f s of processor\n", num_frames,
                static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
}

}  // namespace
}  // namespace motex

int main() {
  for (const motex::Variant& variant :
       {motex::Variant{"4 x 5", 4, 5, 80, 0.05, 0.012}, motex::Variant{"warp 10 %", 4, 5, 80, 0.10, 0.012},
        motex::Variant{"noise doubled", 4, 5, 80, 0.05, 0.024}, motex::Variant{"6 x 3", 6, 3, 80, 0.05, 0.012},
        motex::Variant{"3 x 8", 3, 8, 80, 0.05, 0.012}, motex::Variant{"40 frames", 4, 5, 40, 0.05, 0.012},
        motex::Variant{"160 frames", 4, 5, 160, 0.05, 0.012}})
    motex::measure(variant);
  motex::measure_projection();
  motex::measure_speed();
  return 0;
}
