// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/learn_water.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/parallel.h"
#include "motex/particles/clip_background.h"
#include "motex/particles/pursuit.h"
#include "motex/particles/steady.h"

namespace motex {
namespace {

constexpr int kFewestFrames = 12;
constexpr int kFewestToTell = 30;  // in fewer frames whatever passes is there for a good part of the time, as water is
constexpr double kShown = 0.85;    // share of what moves that bases must show
constexpr double kMostPeaked = 4.8;   // Σ m₄ / Σ m₂² of water
constexpr double kLeastSmooth = 0.3;  // correlation of neighbouring pixels: noise has none
constexpr double kLeastSteady = 0.4;  // of the motion of the liveliest third of the clip, in the stillest
const std::vector<int> kNumbers{200, 400, 800, 1600, 3200};

/// The mean, not the median: power-preserving weights of synthesis suit light whose mean is 0.
Planes mean_over_time(const ClipFrames& clip) {
  Planes mean;
  for (int t = 0; t < clip.num_frames(); ++t) {
    const auto k = static_cast<std::size_t>(t);
    const Planes frame = clip.colour.empty() ? Planes{clip.luma[k]} : to_planes(clip.colour[k], 3);
    if (mean.empty()) mean.assign(frame.size(), Plane(clip.width, clip.height));
    for (std::size_t p = 0; p < frame.size(); ++p)
      for (std::size_t i = 0; i < frame[p].values.size(); ++i) mean[p].values[i] += frame[p].values[i];
  }
  // whole levels, as model files keep them
  for (Plane& plane : mean)
    for (float& value : plane.values) value = std::round(value / static_cast<float>(clip.num_frames()));
  return mean;
}

/// The smallest number of bases that shows enough of the middle frame.
int choose_num_bases(const Plane& residual, const JobContext& job) {
  PursueOptions options;
  options.refine_rounds = 0;
  const JobContext silent{nullptr, nullptr, job.cancel, 1};
  const std::vector<BaseMap> maps = pursue_stages({residual}, kNumbers, options, silent);
  const double all = sum_of_squares(residual);
  for (std::size_t k = 0; k < maps.size(); ++k) {
    Plane left = residual;
    for (const Base& base : maps[k].bases)
      add_patch(left, render_patch(base, left.width, left.height), -base.coefficients[0]);
    if (sum_of_squares(left) <= (1 - kShown) * all) return kNumbers[k];
  }
  return kNumbers.back();
}

std::vector<Plane> light_left(const ClipFrames& clip, const TexturedMotion& model, int jobs) {
  std::vector<Plane> left(clip.luma.size());
  parallel_for(jobs, clip.num_frames(), [&](int t) {
    const auto k = static_cast<std::size_t>(t);
    const BaseMap map = bases_in_frame(model.cables, t, clip.width, clip.height, model.num_planes);
    left[k] = minus(clip.luma[k], luma(reconstruct(map, model.background)));
  });
  return left;
}

double deviation_of(const std::vector<Plane>& planes) {
  double sum = 0, count = 1e-9;
  for (const Plane& plane : planes) {
    sum += sum_of_squares(plane);
    count += static_cast<double>(plane.values.size());
  }
  return std::sqrt(sum / count);
}

SteadyClip steadied(const ClipFrames& clip, const LearnWaterOptions& options, const JobContext& job) {
  if (!options.steady) {
    SteadyClip out;
    out.clip = clip;
    return out;
  }
  job.progress("steadying", 0);
  SteadyClip out = steady(clip, job);
  if (out.moved)
    job.warn("the camera moves by up to " + std::to_string(std::lround(out.largest_shift)) + " pixels: frames " +
             std::to_string(out.first_frame) + " to " + std::to_string(out.first_frame + out.clip.num_frames() - 1) +
             " are used, steadied and cut to " + std::to_string(out.clip.width) + " × " +
             std::to_string(out.clip.height));
  return out;
}

/// Σ m₄ / Σ m₂² over the pixels, moments over time around the mean.
double peakedness(const ClipFrames& clip) {
  const std::size_t area = clip.luma[0].values.size();
  const auto num = static_cast<double>(clip.num_frames());
  std::vector<double> mean(area), second(area), fourth(area);
  for (const Plane& frame : clip.luma)
    for (std::size_t i = 0; i < area; ++i) mean[i] += static_cast<double>(frame.values[i]) / num;
  for (const Plane& frame : clip.luma)
    for (std::size_t i = 0; i < area; ++i) {
      const double d = static_cast<double>(frame.values[i]) - mean[i];
      second[i] += d * d / num;
      fourth[i] += d * d * d * d / num;
    }
  double above = 0, below = 1e-9;
  for (std::size_t i = 0; i < area; ++i) above += fourth[i], below += second[i] * second[i];
  return above / below;
}

/// Correlation over time of pixels beside or below one another, the larger: 0 for the noise of a camera.
double smoothness(const ClipFrames& clip) {
  const std::size_t width = static_cast<std::size_t>(clip.width), area = clip.luma[0].values.size();
  std::vector<float> mean(area), off(area);
  for (const Plane& frame : clip.luma)
    for (std::size_t i = 0; i < area; ++i) mean[i] += frame.values[i] / static_cast<float>(clip.num_frames());
  double beside = 0, below = 0, squares = 1e-9;
  for (const Plane& frame : clip.luma)
    for (std::size_t i = 0; i < area; ++i) {
      off[i] = frame.values[i] - mean[i];
      squares += static_cast<double>(off[i] * off[i]);
      if (i % width != 0) beside += static_cast<double>(off[i] * off[i - 1]);
      if (i >= width) below += static_cast<double>(off[i] * off[i - width]);
    }
  return std::max(beside, below) / squares;
}

/// Energy of the differences between frames in the stillest third of the clip / in the liveliest.
double steadiness(const ClipFrames& clip) {
  double thirds[3] = {0, 0, 0};
  const int num = clip.num_frames() - 1;
  for (int t = 0; t < num; ++t) {
    const std::vector<float>&a = clip.luma[static_cast<std::size_t>(t)].values,
          &b = clip.luma[static_cast<std::size_t>(t) + 1].values;
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<double>((b[i] - a[i]) * (b[i] - a[i]));
    thirds[3 * t / num] += sum;
  }
  return *std::min_element(thirds, thirds + 3) / (*std::max_element(thirds, thirds + 3) + 1e-9);
}

}  // namespace

bool looks_like_water(const ClipFrames& clip, const JobContext& job) {
  if (clip.num_frames() < kFewestToTell || peakedness(clip) > kMostPeaked || smoothness(clip) < kLeastSmooth)
    return false;
  const SteadyClip steady_clip = steady(clip, job);
  return peakedness(steady_clip.clip) <= kMostPeaked && steadiness(steady_clip.clip) >= kLeastSteady;
}

LearnedWater learn_water(const ClipFrames& given, const LearnWaterOptions& options, const JobContext& job) {
  check_options(options);
  if (given.num_frames() < kFewestFrames)
    throw InvalidInput("water is learned from at least " + std::to_string(kFewestFrames) + " frames; the clip has " +
                       std::to_string(given.num_frames()));
  const SteadyClip steady_clip = steadied(given, options, job);
  const ClipFrames& clip = steady_clip.clip;
  LearnedWater out;
  TexturedMotion& model = out.model;
  model.width = clip.width;
  model.height = clip.height;
  model.num_planes = clip.num_planes();
  model.frames_per_sec = clip.frames_per_sec;
  model.num_frames = clip.num_frames();
  model.background = mean_over_time(clip);
  const std::vector<Plane> residuals = luma_residuals(clip, model.background);
  WaterModel water;
  water.flow = estimate_flow_field(residuals, {}, job.jobs);
  CarryOptions carry;
  carry.num_bases = options.num_bases > 0 ? options.num_bases : choose_num_bases(residuals[residuals.size() / 2], job);
  out.num_bases = carry.num_bases;
  model.cables = carry_bases(clip, model.background, water.flow, carry, job.part(0.05, 0.9));
  job.progress("light", 0.9);
  const std::vector<Plane> left = light_left(clip, model, job.jobs);
  out.light = model.noise = deviation_of(left);
  water.light = fit_star(left, water.flow);
  model.water = std::move(water);
  out.carry = measure_cables(clip, model.background, model.cables, job.jobs);
  job.progress("light", 1);
  return out;
}

}  // namespace motex
