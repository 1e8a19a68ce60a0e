// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Synthesized against observed: speed and direction of steps, elements in a frame, where they are; and frames rendered
// a second. Models are files of motex particles learn, or made of the true tracks of a scene (no image needed).
//   particles_synthesis [MODEL | TRACKS.csv | simulate]...
// Distances: TV = total variation ½ Σ |p − q| of histograms (24 bins; speed to 1.25 times its 99 % quantile, direction
// in steps of 15°), W1 = Wasserstein-1 of speed over the mean speed, and of direction around the circle over 180°.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/particles/fit_dynamics.h"
#include "motex/particles/frame_painter.h"
#include "motex/particles/simulate.h"
#include "motex/particles/synthesize.h"
#include "motex/project/textured_motion_file.h"
#include "motex/project/track_csv.h"

namespace motex {
namespace {

constexpr int kBins = 24;
constexpr double kTurn = 2 * std::numbers::pi;

double processor_secs() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Steps {
  std::vector<double> speed, direction, count;
  double mean_count() const {
    double sum = 0;
    for (const double c : count) sum += c;
    return sum / static_cast<double>(count.size());
  }
};

Steps steps_of(const std::vector<Cable>& cables, int width, int height, std::int64_t num_frames) {
  Steps steps;
  steps.count.assign(static_cast<std::size_t>(num_frames), 0);
  const auto inside = [&](const Base& base) {
    return base.x >= -0.5 && base.y >= -0.5 && base.x < width - 0.5 && base.y < height - 0.5;
  };
  for (const Cable& cable : cables)
    for (std::size_t k = 0; k < cable.core.size(); ++k) {
      if (!inside(cable.core[k])) continue;
      const std::int64_t frame = cable.first_frame + static_cast<std::int64_t>(k);
      if (frame >= 0 && frame < num_frames) steps.count[static_cast<std::size_t>(frame)] += 1;
      if (k == 0 || !inside(cable.core[k - 1])) continue;
      const double vx = cable.core[k].x - cable.core[k - 1].x, vy = cable.core[k].y - cable.core[k - 1].y;
      steps.speed.push_back(std::hypot(vx, vy));
      steps.direction.push_back(std::atan2(vy, vx));
    }
  return steps;
}

std::array<double, kBins> histogram(const std::vector<double>& values, double low, double high) {
  std::array<double, kBins> bins{};
  for (const double v : values)
    bins[static_cast<std::size_t>(std::clamp((v - low) / (high - low) * kBins, 0.0, kBins - 1.0))] += 1;
  for (double& bin : bins) bin /= std::max<double>(1, static_cast<double>(values.size()));
  return bins;
}

double total_variation(const std::vector<double>& a, const std::vector<double>& b, double low, double high) {
  const auto p = histogram(a, low, high), q = histogram(b, low, high);
  double sum = 0;
  for (std::size_t k = 0; k < kBins; ++k) sum += std::abs(p[k] - q[k]) / 2;
  return sum;
}

/// Area between the distribution functions, on 4096 points; around a circle less its median.
double wasserstein(std::vector<double> a, std::vector<double> b, double low, double high, bool circular) {
  constexpr int kPoints = 4096;
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  std::vector<double> gaps;
  for (int k = 0; k < kPoints; ++k) {
    const double at = low + (high - low) * (k + 0.5) / kPoints;
    const auto share = [at](const std::vector<double>& v) {
      return static_cast<double>(std::upper_bound(v.begin(), v.end(), at) - v.begin()) /
             std::max<double>(1, static_cast<double>(v.size()));
    };
    gaps.push_back(share(a) - share(b));
  }
  double level = 0, sum = 0;
  if (circular) {
    std::vector<double> sorted = gaps;
    std::nth_element(sorted.begin(), sorted.begin() + kPoints / 2, sorted.end());
    level = sorted[kPoints / 2];
  }
  for (const double gap : gaps) sum += std::abs(gap - level);
  return sum * (high - low) / kPoints;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

void compare(const char* name, const Steps& observed, const Steps& made) {
  std::vector<double> sorted = observed.speed;
  std::sort(sorted.begin(), sorted.end());
  const double top = sorted.empty() ? 1 : 1.25 * std::max(0.1, sorted[sorted.size() * 99 / 100]);
  const double largest =
      std::max(top, made.speed.empty() ? 0 : *std::max_element(made.speed.begin(), made.speed.end()));
  std::printf(
      "  %-22s TV speed %.3f direction %.3f   W1 speed %.3f direction %.3f   count %6.1f against %6.1f (%+.1f %%)\n",
      name, total_variation(observed.speed, made.speed, 0, top),
      total_variation(observed.direction, made.direction, -kTurn / 2, kTurn / 2),
      wasserstein(observed.speed, made.speed, 0, largest, false) / std::max(1e-9, mean_of(observed.speed)),
      wasserstein(observed.direction, made.direction, -kTurn / 2, kTurn / 2, true) / (kTurn / 2), made.mean_count(),
      observed.mean_count(), 100 * (made.mean_count() / observed.mean_count() - 1));
}

/// What learning would give if tracking were perfect.
TexturedMotion model_of_tracks(const std::vector<Track>& tracks, int width, int height) {
  TexturedMotion model;
  model.width = width;
  model.height = height;
  for (const Track& track : tracks) {
    Cable cable;
    for (const TrackPoint& point : track.points) {
      if (point.amplitude == 0) continue;
      if (!cable.core.empty() && point.frame != cable.end_frame()) {
        model.cables.push_back(cable);
        cable.core.clear();
      }
      if (cable.core.empty()) cable.first_frame = point.frame;
      Base core{BaseKind::kGaussian, point.x, point.y, point.scale > 0 ? point.scale : 1.5, 0, {}};
      core.coefficients[0] = static_cast<float>(coefficient_of_peak(core, point.amplitude));
      cable.core.push_back(core);
      model.num_frames = std::max(model.num_frames, point.frame + 1);
    }
    if (!cable.core.empty()) model.cables.push_back(cable);
  }
  model.background = Planes(1, Plane(width, height, 50));
  model.maps = estimate_maps(model.cables, width, height, model.num_frames);
  return model;
}

std::vector<Track> tracks_of_scene(const SimulatedScene& scene) {
  std::vector<Track> tracks;
  for (const SimulatedPoint& point : scene.points) {
    if (tracks.size() <= static_cast<std::size_t>(point.track))
      tracks.resize(static_cast<std::size_t>(point.track) + 1);
    tracks[static_cast<std::size_t>(point.track)].points.push_back(
        {point.frame, point.x, point.y, point.scale, point.angle, point.amplitude});
  }
  return tracks;
}

void measure(const std::string& name, const TexturedMotion& model) {
  const Steps observed = steps_of(model.cables, model.width, model.height, model.num_frames);
  std::printf("%s: %zu cables, %lld frames, %zu bursts\n", name.c_str(), model.cables.size(),
              static_cast<long long>(model.num_frames), model.maps.bursts.size());
  for (const std::int64_t num_frames : {model.num_frames, 10 * model.num_frames})
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      if (num_frames > model.num_frames && seed > 1) continue;
      SynthesizeParticlesOptions options;
      options.seed = seed;
      SynthesizeParticlesReport report;
      const double start = processor_secs();
      const std::vector<Cable> cables = synthesize_cables(model, options, num_frames, {}, &report);
      const double secs = processor_secs() - start;
      const std::string label = std::to_string(num_frames) + " frames, seed " + std::to_string(seed);
      compare(label.c_str(), observed, steps_of(cables, model.width, model.height, num_frames));
      if (num_frames > model.num_frames)
        std::printf("  births a frame %.2f, bursts %.4f, deaths by %s, warm-up %lld frames, %.2f s\n",
                    report.births_per_frame, report.bursts_per_frame, report.deaths_by_age ? "age" : "place",
                    static_cast<long long>(report.warm_up_frames), secs);
    }
}

void measure_rendering() {
  std::printf("rendering 300 bases at 320 x 240, one core, pictures of 8 bits included:\n");
  for (const bool only_gaussians : {true, false})
    for (const std::size_t num_planes : {1U, 3U}) {
      Rng rng(1);
      MovetonFrame frame;
      for (int k = 0; k < 300; ++k) {
        Base base;
        base.kind = only_gaussians ? BaseKind::kGaussian : static_cast<BaseKind>(rng.below(4));
        base.x = rng.uniform(0, 320);
        base.y = rng.uniform(0, 240);
        base.scale = 0.75 * std::pow(4.0, rng.uniform());
        base.angle = rng.uniform(0, std::numbers::pi);
        base.coefficients = {200, 200, 200};
        frame.bases.push_back(base);
      }
      const Planes background(num_planes, Plane(320, 240, 50));
      Planes sum = background;
      Image picture;
      BaseRenderer renderer;
      const double start = processor_secs();
      constexpr int kFrames = 2000;
      for (int t = 0; t < kFrames; ++t) {
        for (std::size_t k = 0; k < sum.size(); ++k)
          std::copy(background[k].values.begin(), background[k].values.end(), sum[k].values.begin());
        renderer.add(frame.bases, sum);
        fill_image(sum, picture);
      }
      std::printf("  %s, %zu plane%s: %.0f frames a second\n", only_gaussians ? "Gaussians" : "all kinds", num_planes,
                  num_planes > 1 ? "s" : "", kFrames / (processor_secs() - start));
    }
}

void measure_simulated() {
  for (const std::uint64_t seed : {1U, 2U}) {
    for (const double elements : {60.0, 150.0, 300.0}) {
      SimulateSnowOptions snow;
      snow.seed = seed;
      snow.elements = elements;
      const SimulatedScene scene = simulate_snow(snow);
      measure(
          "simulated snow, " + std::to_string(static_cast<int>(elements)) + " elements, seed " + std::to_string(seed),
          model_of_tracks(tracks_of_scene(scene), scene.width, scene.height));
    }
  }
  for (const std::uint64_t seed : {1U, 2U}) {
    SimulateBirdsOptions birds;
    birds.seed = seed;
    const SimulatedScene flight = simulate_birds(birds);
    measure("simulated birds, seed " + std::to_string(seed), model_of_tracks(tracks_of_scene(flight), 320, 240));
    SimulateFireworksOptions fireworks;
    fireworks.seed = seed;
    const SimulatedScene sparks = simulate_fireworks(fireworks);
    measure("simulated fireworks, seed " + std::to_string(seed), model_of_tracks(tracks_of_scene(sparks), 320, 240));
  }
}

}  // namespace
}  // namespace motex

int main(int argc, char** argv) {
  using namespace motex;
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty()) names = {"simulate", "render"};
  try {
    for (const std::string& name : names) {
      if (name == "simulate")
        measure_simulated();
      else if (name == "render")
        measure_rendering();
      else if (name.ends_with(".csv"))
        measure(name, model_of_tracks(parse_tracks_csv(read_file(name), name), 320, 240));
      else
        measure(name, load_textured_motion(name));
    }
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
