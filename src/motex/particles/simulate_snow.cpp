// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/rng.h"
#include "motex/particles/simulate.h"
#include "motex/particles/simulated_picture.h"

namespace motex {
namespace {

constexpr int kDrawing = 1, kPaths = 2;  // streams of the generator

struct Flake {
  std::int64_t track = 0;
  double x = 0, y = 0, vx = 0, vy = 0;
  double mean_vx = 0, mean_vy = 0;
  double size = 1, amplitude = 0;
};

class Snowfall {
 public:
  explicit Snowfall(const SimulateSnowOptions& options)
      : options_(options),
        margin_(std::max(8.0, 4 * options.max_size)),
        density_(options.elements / (static_cast<double>(options.width) * options.height)),
        rng_(Rng(options.seed).fork(kPaths)) {
    const int num = draw_poisson(rng_, density_ * area());
    for (int i = 0; i < num; ++i) flakes_.push_back(fresh());
    for (Flake& flake : flakes_) flake.track = next_track_++;
  }

  const std::vector<Flake>& flakes() const { return flakes_; }

  /// What enters in a frame is what would be in sight now and was not before, in snow of the same density all around.
  void advance() {
    for (Flake& flake : flakes_) {
      const double phi = options_.persistence;
      flake.vx = flake.mean_vx + phi * (flake.vx - flake.mean_vx) + options_.deviation * rng_.normal();
      flake.vy = flake.mean_vy + phi * (flake.vy - flake.mean_vy) + options_.deviation * rng_.normal();
      flake.x += flake.vx;
      flake.y += flake.vy;
    }
    std::erase_if(flakes_,
                  [&](const Flake& flake) { return !near(flake.x, flake.y) || rng_.uniform() < options_.vanish; });
    const int num = draw_poisson(rng_, density_ * area());
    for (int i = 0; i < num; ++i) {
      Flake flake = fresh();
      if (near(flake.x - flake.vx, flake.y - flake.vy)) continue;
      flake.track = next_track_++;
      flakes_.push_back(flake);
    }
  }

 private:
  double area() const { return (options_.width + 2 * margin_) * (options_.height + 2 * margin_); }
  bool near(double x, double y) const {
    return x >= -margin_ && y >= -margin_ && x < options_.width + margin_ && y < options_.height + margin_;
  }
  Flake fresh() {
    Flake flake;
    flake.x = rng_.uniform(-margin_, options_.width + margin_);
    flake.y = rng_.uniform(-margin_, options_.height + margin_);
    flake.mean_vx = options_.wind + options_.spread * rng_.normal();
    flake.mean_vy = options_.fall + options_.spread * rng_.normal();
    const double steady = options_.deviation / std::sqrt(1 - options_.persistence * options_.persistence);
    flake.vx = flake.mean_vx + steady * rng_.normal();
    flake.vy = flake.mean_vy + steady * rng_.normal();
    flake.size = rng_.uniform(options_.min_size, options_.max_size);
    flake.amplitude = rng_.uniform(options_.min_amplitude, options_.max_amplitude);
    return flake;
  }

  const SimulateSnowOptions& options_;
  double margin_, density_;
  Rng rng_;
  std::int64_t next_track_ = 0;
  std::vector<Flake> flakes_;
};

}  // namespace

SimulatedScene simulate_snow(const SimulateSnowOptions& options) {
  check_options(options);
  if (options.min_size > options.max_size || options.min_amplitude > options.max_amplitude)
    throw InvalidInput("min_size and min_amplitude must not be above max_size and max_amplitude");
  Rng drawing = Rng(options.seed).fork(kDrawing);
  const Planes background{textured_background(options.width, options.height, options.level, options.texture, drawing)};
  SimulatedScene scene = empty_scene(options, background);
  scene.mean_velocity_x = options.wind;
  scene.mean_velocity_y = options.fall;
  Snowfall snow(options);
  std::vector<std::vector<Flake>> shown;
  for (int t = 0; t < options.frames; ++t) {
    if (t > 0) snow.advance();
    for (const Flake& flake : snow.flakes())
      if (is_inside(flake.x, flake.y, options.width, options.height))
        scene.points.push_back({t, flake.track, flake.x, flake.y, flake.size, 0, flake.amplitude, 0});
    shown.push_back(snow.flakes());
  }
  draw_frames(scene, background, options.frames, options.noise, options.seed, [&](int t, Planes& planes) {
    for (const Flake& flake : shown[static_cast<std::size_t>(t)])
      add_blob(planes, {flake.x, flake.y, flake.size, flake.size, 0, {flake.amplitude}});
  });
  return scene;
}

ClipFrames clip_frames_of(const SimulatedScene& scene) {
  ClipFrames clip;
  clip.width = scene.width;
  clip.height = scene.height;
  clip.frames_per_sec = scene.frames_per_sec;
  bool coloured = false;
  for (const Image& frame : scene.frames) {
    clip.luma.push_back(luma(frame));
    coloured = coloured || !is_grey(frame);
  }
  if (coloured) clip.colour = scene.frames;
  return clip;
}

std::vector<Cable> true_cables(const SimulatedScene& scene) {
  std::vector<const SimulatedPoint*> points;
  for (const SimulatedPoint& point : scene.points)
    if (point.amplitude != 0) points.push_back(&point);
  std::stable_sort(points.begin(), points.end(), [](const SimulatedPoint* a, const SimulatedPoint* b) {
    return a->track != b->track ? a->track < b->track : a->frame < b->frame;
  });
  std::vector<Cable> cables;
  const SimulatedPoint* last = nullptr;
  for (const SimulatedPoint* point : points) {
    if (last == nullptr || last->track != point->track || last->frame + 1 != point->frame) {
      cables.emplace_back().first_frame = point->frame;
    }
    Base base;
    base.kind = BaseKind::kGaussian;
    base.x = point->x;
    base.y = point->y;
    base.scale = point->scale;
    base.angle = 0;
    const auto coefficient = static_cast<float>(coefficient_of_peak(base, point->amplitude));
    base.coefficients = {coefficient, coefficient, coefficient};
    cables.back().core.push_back(base);
    cables.back().poses.push_back(point->state);
    last = point;
  }
  return cables;
}

}  // namespace motex
