// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Linked detections against cables sampled from them, on scenes with known truth made here: snow of 60, 150 and 300
// elements a frame (256 x 192 x 30, places with velocity of persistence 0.7, textured background, noise 4), three
// seeds. Tracks within 6 px of the picture's edge are cut there; gate 3 px. Prints JSC over tracks, beta, the error of
// places, log posterior of the chain and of the truth, processor seconds, and how often moves were taken.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include "motex/core/rng.h"
#include "motex/particles/cable_sampler.h"
#include "motex/particles/cable_tracks.h"
#include "motex/particles/clip_background.h"
#include "motex/particles/core_image.h"
#include "motex/particles/detect_cores.h"
#include "motex/particles/track_elements.h"
#include "motex/particles/track_score.h"

namespace motex {
namespace {

constexpr int kWidth = 256, kHeight = 192, kFrames = 30;
constexpr double kMargin = 24, kPersistence = 0.7, kStep = 0.25, kNoise = 4;

struct Flake {
  double x, y, vx, vy, scale, peak;
  std::size_t cable;
};

struct Scene {
  ClipFrames clip;
  std::vector<Cable> truth;
};

Flake new_flake(bool at_edge, Rng& rng) {
  Flake flake{};
  flake.x = rng.uniform(-kMargin, kWidth + kMargin);
  flake.y = rng.uniform(-kMargin, kHeight + kMargin);
  if (at_edge) {  // in proportion to what flows in at the right and at the top
    const double right = 2 * (kHeight + 2 * kMargin), top = 3 * (kWidth + 2 * kMargin);
    if (rng.uniform() < right / (right + top))
      flake.x = kWidth + kMargin - rng.uniform(0, 2);
    else
      flake.y = -kMargin + rng.uniform(0, 3);
  }
  const double spread = kStep / std::sqrt(1 - kPersistence * kPersistence);
  flake.vx = -2 + spread * rng.normal();
  flake.vy = 3 + spread * rng.normal();
  flake.scale = rng.uniform(0.9, 2.2);
  flake.peak = rng.uniform(40, 110);
  return flake;
}

Plane textured_background(Rng& rng) {
  Plane plane(kWidth, kHeight, 70);
  for (int i = 0; i < 900; ++i) {
    const CoreState z{rng.uniform(0, kWidth), rng.uniform(0, kHeight), std::log(3.5), 12 * rng.normal(), 0};
    ResidualFrame frame(plane);
    paint_core(frame, BaseKind::kGaussian, z, 1);
    for (int y = 0; y < kHeight; ++y) std::copy_n(frame.row(y), kWidth, plane.row(y));
  }
  return plane;
}

Scene make_scene(int per_frame, std::uint64_t seed) {
  Rng rng(seed);
  Scene scene;
  scene.clip.width = kWidth;
  scene.clip.height = kHeight;
  const Plane background = textured_background(rng);
  const auto population = static_cast<std::size_t>(
      std::lround(per_frame * (kWidth + 2 * kMargin) * (kHeight + 2 * kMargin) / (kWidth * kHeight)));
  std::vector<Flake> live;
  for (int t = 0; t < kFrames; ++t) {
    while (live.size() < population) {
      live.push_back(new_flake(t > 0, rng));
      live.back().cable = scene.truth.size();
      scene.truth.push_back({t, {}, {}, -1, {}});
    }
    Plane plane = background;
    for (float& value : plane.values) value += static_cast<float>(kNoise * rng.normal());
    ResidualFrame frame(plane);
    for (const Flake& flake : live) {
      const CoreState z{flake.x, flake.y, std::log(flake.scale), flake.peak, 0};
      scene.truth[flake.cable].core.push_back(core_base(BaseKind::kGaussian, z));
      paint_core(frame, BaseKind::kGaussian, z, 1);
    }
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) plane.at(x, y) = std::clamp(std::round(frame.row(y)[x]), 0.0F, 255.0F);
    scene.clip.luma.push_back(plane);
    for (Flake& flake : live) {
      flake.vx = -2 + kPersistence * (flake.vx + 2) + kStep * rng.normal();
      flake.vy = 3 + kPersistence * (flake.vy - 3) + kStep * rng.normal();
      flake.x += flake.vx;
      flake.y += flake.vy;
    }
    std::erase_if(live, [](const Flake& flake) { return flake.x <= -kMargin || flake.y >= kHeight + kMargin; });
  }
  return scene;
}

std::vector<Track> inside(const std::vector<Cable>& cables, double border) {
  std::vector<Track> tracks = tracks_of(cables, 1);
  for (Track& track : tracks)
    std::erase_if(track.points, [&](const TrackPoint& point) {
      return point.x < border - 0.5 || point.y < border - 0.5 || point.x >= kWidth - 0.5 - border ||
             point.y >= kHeight - 0.5 - border;
    });
  std::erase_if(tracks, [](const Track& track) { return track.points.empty(); });
  return tracks;
}

void print_score(const char* name, const Scene& scene, const std::vector<Cable>& cables, double secs) {
  const TrackingScore score = score_tracks(inside(scene.truth, 6), inside(cables, 6), 3);
  const TrackingScore whole = score_tracks(inside(scene.truth, 0), inside(cables, 0), 5);
  std::printf("  %-8s JSC over tracks %.3f (true %d, found %d)  beta at 5 px %.3f  rmse %.3f px  %.1f s\n", name,
              score.jsc_tracks, score.num_true, score.num_estimated, whole.beta, score.rmse, secs);
}

double processor_secs() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void measure(int per_frame, std::uint64_t seed, bool with_moves) {
  const Scene scene = make_scene(per_frame, seed);
  std::printf("%d elements a frame, seed %d\n", per_frame, static_cast<int>(seed));
  const ClipBackground background(scene.clip, BackgroundKind::kMedian, {});
  const double begin = processor_secs();
  TrackElementsReport tracked;
  const std::vector<Cable> linked =
      track_elements(scene.clip, background.still()[0], 0, TrackElementsOptions{}, {}, &tracked);
  const double after_linking = processor_secs();
  print_score("linked", scene, linked, after_linking - begin);

  std::vector<Plane> residuals = scene.clip.luma;
  for (Plane& plane : residuals)
    for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] -= tracked.background.values[i];
  EstimatePriorOptions prior_options;
  prior_options.noise = tracked.noise;
  prior_options.num_frames = kFrames;
  SampleCablesOptions options;
  options.learn_sweeps = options.sweeps * 2 / 3;
  options.static_background = true;
  const SampleCablesReport report =
      sample_cables(residuals, linked, estimate_prior(linked, kWidth, kHeight, prior_options), options);
  const double secs = processor_secs() - after_linking;
  print_score("sampled", scene, report.cables, secs);

  for (Plane& plane : residuals)
    for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] -= report.background_change.values[i];
  std::printf("  log posterior %.0f -> %.0f, of the truth %.0f; %.0f k proposals a second; persistence %.2f %.2f\n",
              report.log_posterior_trace.front(), report.log_posterior_trace.back(),
              log_posterior_of(residuals, scene.truth, report.prior),
              static_cast<double>(report.num_proposals) / secs / 1000, report.prior.dynamics.x.persistence(),
              report.prior.dynamics.y.persistence());
  std::fflush(stdout);
  if (!with_moves) return;
  for (const MoveCount& move : report.moves)
    std::printf(
        "  %-12s %9lld proposed, %6.2f %% accepted\n", move.name.c_str(), static_cast<long long>(move.proposed),
        move.proposed > 0 ? 100.0 * static_cast<double>(move.accepted) / static_cast<double>(move.proposed) : 0);
}

}  // namespace
}  // namespace motex

/// particles_sampling [ELEMENTS [SEED]]
int main(int num_args, char** args) {
  const int only = num_args > 1 ? std::atoi(args[1]) : 0, seed = num_args > 2 ? std::atoi(args[2]) : 0;
  for (const int per_frame : {60, 150, 300})
    for (int k = 1; k <= 3; ++k)
      if ((only == 0 || only == per_frame) && (seed == 0 || seed == k))
        motex::measure(per_frame, static_cast<std::uint64_t>(k), k == 1);
  return EXIT_SUCCESS;
}
