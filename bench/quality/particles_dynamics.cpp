// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Dynamics, wind, bursts, wing states and maps on scenes whose truth is known: from true places, from places with
// errors, and from what tracking finds in the frames.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/particles/birth_death.h"
#include "motex/particles/bursts.h"
#include "motex/particles/cable_sampler.h"
#include "motex/particles/fit_dynamics.h"
#include "motex/particles/simulate.h"
#include "motex/particles/track_elements.h"

namespace motex {
namespace {

double processor_secs() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::vector<Cable> with_errors(std::vector<Cable> cables, double error, Rng& rng) {
  for (Cable& cable : cables)
    for (Base& base : cable.core) {
      base.x += error * rng.normal();
      base.y += error * rng.normal();
    }
  return cables;
}

std::vector<Cable> tracked(const SimulatedScene& scene, TrackElementsReport* report = nullptr) {
  const ClipFrames clip = clip_frames_of(scene);
  std::vector<Planes> frames;
  for (const Plane& plane : clip.luma) frames.push_back({plane});
  return track_elements(clip, quantile_over_time(frames, 0.5)[0], 0, {}, {}, report);
}

/// Places drawn from their posterior given the frames, from that start.
std::vector<Cable> sampled(const SimulatedScene& scene, const std::vector<Cable>& start, std::uint64_t seed) {
  std::vector<Plane> residuals = clip_frames_of(scene).luma;
  const Plane background = luma(scene.background);
  for (Plane& residual : residuals)
    for (std::size_t i = 0; i < residual.values.size(); ++i) residual.values[i] -= background.values[i];
  EstimatePriorOptions prior_options;
  prior_options.num_frames = static_cast<int>(scene.frames.size());
  SampleCablesOptions options;
  options.learn_sweeps = options.sweeps;
  options.seed = seed;
  return sample_cables(residuals, start, estimate_prior(start, scene.width, scene.height, prior_options), options)
      .cables;
}

double degrees_between(double ax, double ay, double bx, double by) {
  return std::abs(std::remainder(std::atan2(ay, ax) - std::atan2(by, bx), 2 * std::numbers::pi)) * 180 /
         std::numbers::pi;
}

/// Mean of all true steps: the wind that blew, not the one that was asked for.
std::pair<double, double> mean_step(const std::vector<Cable>& cables) {
  double x = 0, y = 0, count = 0;
  for (const Cable& cable : cables)
    for (std::size_t t = 1; t < cable.core.size(); ++t) {
      x += cable.core[t].x - cable.core[t - 1].x;
      y += cable.core[t].y - cable.core[t - 1].y;
      count += 1;
    }
  return {x / std::max(count, 1.0), y / std::max(count, 1.0)};
}

void measure_dynamics(double elements, double persistence, double deviation, std::uint64_t seed, bool from_frames) {
  SimulateSnowOptions options;
  options.elements = elements;
  options.persistence = persistence;
  options.deviation = deviation;
  options.frames = 60;
  options.seed = seed;
  const SimulatedScene scene = simulate_snow(options);
  const std::vector<Cable> truth = true_cables(scene);
  const auto [wind_x, wind_y] = mean_step(truth);
  const auto report = [&, wind_x = wind_x, wind_y = wind_y](const char* from, const std::vector<Cable>& cables,
                                                            const FitDynamicsOptions& fit_options) {
    FitDynamicsReport details;
    const double start = processor_secs();
    const MovetonDynamics dynamics = fit_dynamics(cables, fit_options, &details);
    const double secs = processor_secs() - start;
    std::printf(
        "%4.0f a frame, phi %.2f, seed %llu, %-22s phi x %.3f y %.3f  d %.3f %.3f  error %.2f %.2f px  wind %.2f deg "
        "of "
        "what blew, %.2f of what was asked  %.2f s\n",
        elements, persistence, static_cast<unsigned long long>(seed), from, dynamics.x.persistence(),
        dynamics.y.persistence(), dynamics.x.d, dynamics.y.d, details.position_error_x, details.position_error_y,
        degrees_between(dynamics.x.mean_velocity(), dynamics.y.mean_velocity(), wind_x, wind_y),
        degrees_between(dynamics.x.mean_velocity(), dynamics.y.mean_velocity(), options.wind, options.fall), secs);
    std::fflush(stdout);
  };
  FitDynamicsOptions unknown;
  unknown.estimate_errors = true;
  report("true places", truth, {});
  Rng rng(seed);
  for (const double error : {0.2, 0.5}) {
    const std::vector<Cable> measured = with_errors(truth, error, rng);
    FitDynamicsOptions told;
    told.position_error = error;
    const std::string name = "error " + std::to_string(error).substr(0, 3);
    report((name + ", regressed").c_str(), measured, {});
    report((name + ", told").c_str(), measured, told);
    report((name + ", found").c_str(), measured, unknown);
  }
  if (!from_frames) return;
  TrackElementsReport tracking;
  const std::vector<Cable> found = tracked(scene, &tracking);
  report("tracked, regressed", found, {});
  report("tracked, found", found, unknown);
  report("tracked, as seen", tracking.seen, unknown);
  report("tracked, sampled", sampled(scene, found, seed), {});
  report("error 0.5, sampled", sampled(scene, with_errors(truth, 0.5, rng), seed), {});
}

void measure_bursts(std::uint64_t seed, bool from_frames) {
  SimulateFireworksOptions options;
  options.seed = seed;
  const SimulatedScene scene = simulate_fireworks(options);
  const std::vector<Cable> cables = from_frames ? tracked(scene) : true_cables(scene);
  const std::vector<Burst> bursts = find_bursts(cables);
  std::printf("fireworks, seed %llu, %s: %zu bursts of %zu;", static_cast<unsigned long long>(seed),
              from_frames ? "tracked" : "true paths", bursts.size(), scene.bursts.size());
  for (const SimulatedBurst& truth : scene.bursts) {
    const Burst* nearest = nullptr;
    for (const Burst& burst : bursts)
      if (nearest == nullptr || std::abs(burst.frame - truth.frame) < std::abs(nearest->frame - truth.frame))
        nearest = &burst;
    if (nearest == nullptr) continue;
    std::printf("  %.2f frames %.2f px (%zu of %d)", nearest->frame - truth.frame,
                std::hypot(nearest->x - truth.x, nearest->y - truth.y), nearest->cables.size(), truth.num_sparks);
  }
  std::puts("");
  std::fflush(stdout);
}

void measure_wings(std::uint64_t seed) {
  SimulateBirdsOptions options;
  options.seed = seed;
  options.frames = 60;
  const SimulatedScene scene = simulate_birds(options);
  std::vector<std::vector<int>> states;
  for (const Cable& cable : true_cables(scene)) states.push_back(cable.poses);
  const TransitionMatrix found = TransitionMatrix::from_sequences(3, states);
  double largest = 0, count = 0;
  for (int i = 0; i < 3; ++i) {
    count += found.row_count(i);
    for (int j = 0; j < 3; ++j)
      largest = std::max(largest, std::abs(found.probability(i, j) - scene.wing_transitions.probability(i, j)));
  }
  std::printf("birds, seed %llu: %.0f transitions, largest error of an entry %.3f\n",
              static_cast<unsigned long long>(seed), count, largest);
}

/// Half the sum of differences of the two densities.
double distance(const Plane& a, const Plane& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    sum += std::abs(static_cast<double>(a.values[i]) - static_cast<double>(b.values[i])) / 2;
  return sum;
}

void measure_maps(double elements, std::uint64_t seed) {
  SimulateSnowOptions options;
  options.elements = elements;
  options.seed = seed;
  options.frames = 60;
  const SimulatedScene scene = simulate_snow(options);
  const std::vector<Cable> truth = true_cables(scene), found = tracked(scene);
  MapOptions unbridged;
  unbridged.bridge_gaps = false;
  const BirthDeathMaps of_truth = estimate_maps(truth, options.width, options.height, options.frames, unbridged);
  const BirthDeathMaps raw = estimate_maps(found, options.width, options.height, options.frames, unbridged);
  const double start = processor_secs();
  const BirthDeathMaps maps = estimate_maps(found, options.width, options.height, options.frames);
  std::printf(
      "maps, %.0f a frame, seed %llu: births a frame true %.2f, of tracks %.2f, bridged %.2f; distance of source maps "
      "%.3f, %.3f; bandwidth %.1f px; bursts %zu; %.2f s\n",
      elements, static_cast<unsigned long long>(seed), of_truth.births_per_frame, raw.births_per_frame,
      maps.births_per_frame, distance(of_truth.source, raw.source), distance(of_truth.source, maps.source),
      maps.bandwidth, maps.bursts.size(), processor_secs() - start);
  std::fflush(stdout);
}

int run(int first_seed, int num_seeds, const std::string& part) {
  for (int i = 0; i < num_seeds; ++i) {
    const auto seed = static_cast<std::uint64_t>(first_seed + i);
    if (part.empty() || part == "dynamics") {
      for (const double elements : {60.0, 150.0, 300.0}) measure_dynamics(elements, 0.7, 0.25, seed, true);
      measure_dynamics(150, 0.9, 0.35, seed, true);
      measure_dynamics(150, 0.3, 0.4, seed, true);
    }
    if (part.empty() || part == "bursts") {
      measure_bursts(seed, false);
      measure_bursts(seed, true);
    }
    if (part.empty() || part == "wings") measure_wings(seed);
    if (part.empty() || part == "maps")
      for (const double elements : {60.0, 150.0, 300.0}) measure_maps(elements, seed);
  }
  return 0;
}

}  // namespace
}  // namespace motex

/// particles_dynamics [FIRST_SEED [NUM_SEEDS [dynamics|bursts|wings|maps]]]; without arguments seed 1
int main(int argc, char** argv) {
  try {
    return motex::run(argc > 1 ? std::atoi(argv[1]) : 1, argc > 2 ? std::atoi(argv[2]) : 1, argc > 3 ? argv[3] : "");
  } catch (const motex::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
