// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Synthesized against observed: speed and direction of steps, elements in a frame, births, lives, birthplaces; and
// frames rendered a second. Models are files of motex particles learn, or made of the true tracks of a scene (no image
// needed).
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
constexpr std::size_t kRuns = 10;
constexpr int kWindows = 10;  // clips that a run is long, when all are taken together
constexpr std::uint64_t kOtherClips = 5;
constexpr double kTurn = 2 * std::numbers::pi;

double processor_secs() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// What is seen of elements between two frames; cables that are there at both ends are cut.
struct Sights {
  std::vector<double> speed, direction;  // of steps
  std::vector<double> count;             // elements, by frame
  std::vector<double> lives;             // frames
  std::vector<double> birth_x, birth_y;  // of those not there in the first frame, shares of the picture
};

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

struct PictureSize {
  int width = 0, height = 0;
  bool has(const Base& base) const {
    return base.x >= -0.5 && base.y >= -0.5 && base.x < width - 0.5 && base.y < height - 0.5;
  }
};

/// Adds what is seen in frames first … first + num_frames − 1.
void add_sights(const std::vector<Cable>& cables, const PictureSize& size, std::int64_t first, std::int64_t num_frames,
                Sights& sights) {
  std::vector<double> count(static_cast<std::size_t>(num_frames), 0);
  for (const Cable& cable : cables) {
    const Base* last = nullptr;
    double life = 0;
    for (std::int64_t frame = std::max(first, cable.first_frame);
         frame < std::min(first + num_frames, cable.end_frame()); ++frame) {
      const Base& base = cable.at(frame);
      if (!size.has(base)) {
        last = nullptr;
        continue;
      }
      count[static_cast<std::size_t>(frame - first)] += 1;
      if (life == 0 && frame > first) {
        sights.birth_x.push_back((base.x + 0.5) / size.width);
        sights.birth_y.push_back((base.y + 0.5) / size.height);
      }
      life += 1;
      if (last != nullptr) {
        sights.speed.push_back(std::hypot(base.x - last->x, base.y - last->y));
        sights.direction.push_back(std::atan2(base.y - last->y, base.x - last->x));
      }
      last = &base;
    }
    if (life > 0) sights.lives.push_back(life);
  }
  sights.count.insert(sights.count.end(), count.begin(), count.end());
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

/// How far two sights are apart. Differences are signed shares of the first one's.
struct Apart {
  double tv_speed = 0, tv_direction = 0;
  double w1_speed = 0, w1_direction = 0;  // over the mean speed; over 180°
  double w1_count = 0, w1_life = 0;       // over their means
  double w1_birthplace = 0;               // mean of across and down, over the picture's size
  double count = 0, births = 0;

  static Apart of(const Sights& a, const Sights& b);
  template <typename Visitor>
  void visit(Visitor&& visitor) {
    for (double* value :
         {&tv_speed, &tv_direction, &w1_speed, &w1_direction, &w1_count, &w1_life, &w1_birthplace, &count, &births})
      visitor(*value);
  }
};

double linear_wasserstein(const std::vector<double>& a, const std::vector<double>& b) {
  double high = 1e-9;
  for (const auto* values : {&a, &b})
    for (const double v : *values) high = std::max(high, v);
  return wasserstein(a, b, 0, high, false);
}

Apart Apart::of(const Sights& a, const Sights& b) {
  std::vector<double> sorted = a.speed;
  std::sort(sorted.begin(), sorted.end());
  const double top = sorted.empty() ? 1 : 1.25 * std::max(0.1, sorted[sorted.size() * 99 / 100]);
  const auto births_per_frame = [](const Sights& sights) {
    return static_cast<double>(sights.birth_x.size()) / static_cast<double>(sights.count.size());
  };
  Apart apart;
  apart.tv_speed = total_variation(a.speed, b.speed, 0, top);
  apart.tv_direction = total_variation(a.direction, b.direction, -kTurn / 2, kTurn / 2);
  apart.w1_speed = linear_wasserstein(a.speed, b.speed) / std::max(1e-9, mean_of(a.speed));
  apart.w1_direction = wasserstein(a.direction, b.direction, -kTurn / 2, kTurn / 2, true) / (kTurn / 2);
  apart.w1_count = linear_wasserstein(a.count, b.count) / mean_of(a.count);
  apart.w1_life = linear_wasserstein(a.lives, b.lives) / mean_of(a.lives);
  apart.w1_birthplace = (linear_wasserstein(a.birth_x, b.birth_x) + linear_wasserstein(a.birth_y, b.birth_y)) / 2;
  apart.count = mean_of(b.count) / mean_of(a.count) - 1;
  apart.births = births_per_frame(a) > 0 ? births_per_frame(b) / births_per_frame(a) - 1 : 0;
  return apart;
}

/// Mean of each number over some runs (of differences: of their sizes), and the largest.
void print_runs(const char* name, std::vector<Apart> runs) {
  std::vector<double> sums(9), largest(9);
  for (Apart& run : runs) {
    std::size_t k = 0;
    run.visit([&](double value) {
      sums[k] += std::abs(value) / static_cast<double>(runs.size());
      largest[k] = std::abs(value) > std::abs(largest[k]) ? value : largest[k];
      ++k;
    });
  }
  std::printf("  %-20s", name);
  for (std::size_t k = 0; k < 7; ++k)
    runs.size() > 1 ? std::printf("  %.3f (%.3f)", sums[k], largest[k]) : std::printf("  %.3f        ", sums[k]);
  for (std::size_t k = 7; k < 9; ++k)
    runs.size() > 1 ? std::printf("  %5.1f %% (%+.1f)", 100 * sums[k], 100 * largest[k])
                    : std::printf("  %+5.1f %%        ", 100 * largest[k]);
  std::puts("");
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

/// Runs as long as the clip against it; many of them together, which tells what is wrong from what is chance; and each
/// against all, which is chance alone.
void measure(const std::string& name, const TexturedMotion& model) {
  const PictureSize size{model.width, model.height};
  Sights observed, all;
  add_sights(model.cables, size, 0, model.num_frames, observed);
  std::printf("%s: %zu cables, %lld frames, %zu bursts, %.1f in a frame\n", name.c_str(), model.cables.size(),
              static_cast<long long>(model.num_frames), model.maps.bursts.size(), mean_of(observed.count));
  std::printf("  %-20s  %-13s  %-13s  %-13s  %-13s  %-13s  %-13s  %-13s  %-14s  %s\n", "mean (largest)", "TV speed",
              "direction", "W1 speed", "direction", "count", "life", "birthplace", "count", "births");
  std::vector<Sights> runs(kRuns);
  const double start = processor_secs();
  SynthesizeParticlesReport report;
  for (std::size_t run = 0; run < kRuns; ++run) {
    SynthesizeParticlesOptions options;
    options.seed = run + 1;
    const std::vector<Cable> cables = synthesize_cables(model, options, kWindows * model.num_frames, {}, &report);
    add_sights(cables, size, 0, model.num_frames, runs[run]);
    for (int window = 0; window < kWindows; ++window)
      add_sights(cables, size, window * model.num_frames, model.num_frames, all);
  }
  std::vector<Apart> from_observed, from_all;
  for (const Sights& run : runs) {
    from_observed.push_back(Apart::of(observed, run));
    from_all.push_back(Apart::of(all, run));
  }
  print_runs("runs from the clip", from_observed);
  print_runs("all from the clip", {Apart::of(observed, all)});
  print_runs("runs from all", from_all);
  std::printf("  births a frame %.2f, bursts %.4f, deaths by %s, warm-up %lld frames, %.2f s\n",
              report.births_per_frame, report.bursts_per_frame, report.deaths_by_age ? "age" : "place",
              static_cast<long long>(report.warm_up_frames), processor_secs() - start);
}

/// Other clips of the same simulation from the first: chance of nature, beside which that of a synthesis is seen.
void measure_nature(const std::vector<SimulatedScene>& scenes) {
  std::vector<Sights> clips;
  for (const SimulatedScene& scene : scenes) {
    const TexturedMotion model = model_of_tracks(tracks_of_scene(scene), scene.width, scene.height);
    add_sights(model.cables, {scene.width, scene.height}, 0, model.num_frames, clips.emplace_back());
  }
  std::vector<Apart> others;
  for (std::size_t k = 1; k < clips.size(); ++k) others.push_back(Apart::of(clips[0], clips[k]));
  print_runs("nature from the clip", others);
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

/// simulate: the scene of a seed.
void measure_simulated(const std::string& name, const auto& simulate) {
  for (const std::uint64_t seed : {1U, 2U}) {
    std::vector<SimulatedScene> scenes;
    for (std::uint64_t other = 0; other <= kOtherClips; ++other) scenes.push_back(simulate(seed + 100 * other));
    measure(name + ", seed " + std::to_string(seed),
            model_of_tracks(tracks_of_scene(scenes[0]), scenes[0].width, scenes[0].height));
    measure_nature(scenes);
  }
}

void measure_simulations() {
  for (const double elements : {60.0, 150.0, 300.0})
    measure_simulated("simulated snow, " + std::to_string(static_cast<int>(elements)) + " elements",
                      [elements](std::uint64_t seed) {
                        SimulateSnowOptions snow;
                        snow.seed = seed;
                        snow.elements = elements;
                        return simulate_snow(snow);
                      });
  measure_simulated("simulated birds", [](std::uint64_t seed) {
    SimulateBirdsOptions birds;
    birds.seed = seed;
    return simulate_birds(birds);
  });
  measure_simulated("simulated fireworks", [](std::uint64_t seed) {
    SimulateFireworksOptions fireworks;
    fireworks.seed = seed;
    return simulate_fireworks(fireworks);
  });
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
        measure_simulations();
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
