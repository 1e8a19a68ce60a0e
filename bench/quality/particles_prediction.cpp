// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// One frame ahead: fitted on the first 70 % of each clip, PSNR of frame t + 1 from frames ≤ t on the rest, for the mean
// frame, the last frame, linear dynamic textures, the spatio-temporal autoregression, and the elements learned.
// Clips: those named, or snow of three densities made by simulate_scene() with three seeds.
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "bench/peers/linear_dynamic_texture.h"
#include "motex/core/error.h"
#include "motex/particles/carry_bases.h"
#include "motex/particles/predict.h"
#include "motex/particles/simulate.h"
#include "motex/particles/star.h"
#include "motex/project/load_video_clip.h"

namespace motex {
namespace {

Plane mean_of(const std::vector<Plane>& frames) {
  Plane mean(frames[0].width, frames[0].height);
  for (const Plane& frame : frames)
    for (std::size_t i = 0; i < mean.values.size(); ++i)
      mean.values[i] += frame.values[i] / static_cast<float>(frames.size());
  return mean;
}

/// Mean PSNR of `predict(t)` over the held-out frames.
double score(const ClipFrames& clip, int first, const std::function<Plane(std::size_t)>& predict) {
  double sum = 0;
  for (int t = first; t < clip.num_frames(); ++t)
    sum += psnr(predict(static_cast<std::size_t>(t)), clip.luma[static_cast<std::size_t>(t)]);
  return sum / (clip.num_frames() - first);
}

double score_dynamic_texture(const ClipFrames& clip, int first, int rank) {
  std::vector<Planes> training;
  for (int t = 0; t < first; ++t) training.push_back({clip.luma[static_cast<std::size_t>(t)]});
  const peers::LinearDynamicTexture texture(training, rank);
  return score(clip, first, [&](std::size_t t) { return texture.predict({clip.luma[t - 1]})[0]; });
}

double score_star(const ClipFrames& clip, const ClipFrames& training) {
  std::vector<Plane> residuals = training.luma;
  const Plane mean = mean_of(residuals);
  for (Plane& plane : residuals)
    for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] -= mean.values[i];
  const StarModel star = fit_star(training.luma, estimate_flow_field(residuals), {2, 2, 0});
  return score(clip, training.num_frames(), [&](std::size_t t) {
    return predict_star(star, {clip.luma[t - 2], clip.luma[t - 1]});
  });
}

void measure(const std::string& name, const ClipFrames& clip) {
  const int first = clip.num_frames() * 7 / 10;
  ClipFrames training = clip;
  training.luma.resize(static_cast<std::size_t>(first));
  training.colour.clear();
  const Plane mean = mean_of(training.luma);
  std::printf("%-26s mean frame %.2f", name.c_str(), score(clip, first, [&](std::size_t) { return mean; }));
  std::printf("  last frame %.2f", score(clip, first, [&](std::size_t t) { return clip.luma[t - 1]; }));
  for (const int rank : {5, 20, 60}) std::printf("  LDT %d: %.2f", rank, score_dynamic_texture(clip, first, rank));
  std::printf("  STAR %.2f", score_star(clip, training));
  const std::clock_t start = std::clock();
  try {
    FramePredictor predictor(training);
    const double ours = score(clip, first, [&](std::size_t t) {
      if (static_cast<int>(t) > first) predictor.observe(clip.luma[t - 1]);
      return predictor.predict();
    });
    std::printf("  ours %.2f (%.1f s)\n", ours, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  } catch (const Error& error) {
    std::printf("  ours: %s\n", error.what());
  }
  std::fflush(stdout);
}

/// Snow of the study's scenes: velocity (1.5, 6) ± 1, φ .9, deviation .35, bright flakes, noise 4.
void measure_simulated(double elements, std::uint64_t seed) {
  SimulateSnowOptions options;
  options.elements = elements;
  options.wind = 1.5;
  options.fall = 6;
  options.persistence = 0.9;
  options.deviation = 0.35;
  options.min_size = 1.2;
  options.min_amplitude = 90;
  options.max_amplitude = 180;
  options.level = 30;
  options.texture = 0;
  options.seed = seed;
  const SimulatedScene scene = simulate_snow(options);
  ClipFrames clip{scene.width, scene.height, scene.frames_per_sec, {}, {}};
  for (const Image& frame : scene.frames) clip.luma.push_back(luma(frame));
  measure("simulated " + std::to_string(static_cast<int>(elements)) + ", seed " + std::to_string(seed), clip);
}

}  // namespace
}  // namespace motex

int main(int argc, char** argv) {
  using namespace motex;
  try {
    for (int k = 1; k < argc; ++k) measure(argv[k], load_video_clip(argv[k]));
    for (const double elements : {60.0, 150.0, 300.0})
      for (std::uint64_t seed = 1; argc == 1 && seed <= 3; ++seed) measure_simulated(elements, seed);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
