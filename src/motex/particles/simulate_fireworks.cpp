// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/rng.h"
#include "motex/particles/simulate.h"
#include "motex/particles/simulated_picture.h"

namespace motex {
namespace {

constexpr int kPaths = 2;   // streams of the generator
constexpr double kSky = 8;  // grey levels
constexpr std::array<std::array<double, 3>, 5> kColours{
    {{1.5, 0.75, 0.6}, {0.7, 1.15, 0.8}, {0.8, 0.95, 1.9}, {1.25, 1.0, 0.4}, {1.0, 1.0, 1.0}}};

struct Spark {
  std::int64_t track = 0;
  double x = 0, y = 0, vx = 0, vy = 0;
  double age = 0, life = 1, size = 1, amplitude = 0;
  int colour = 0;

  double brightness() const { return age < life ? amplitude * std::pow(1 - age / life, 0.7) : 0; }
};

/// Luma 1, so that amplitudes are of the luma.
std::array<double, 3> unit_colour(int idx) {
  std::array<double, 3> colour = kColours[static_cast<std::size_t>(idx)];
  const double light = luma_of(colour[0], colour[1], colour[2]);
  for (double& value : colour) value /= light;
  return colour;
}

class Show {
 public:
  explicit Show(const SimulateFireworksOptions& options) : options_(options), rng_(Rng(options.seed).fork(kPaths)) {
    const double last = std::max(1.0, options.frames - 1 - 0.4 * options.min_life);
    for (int i = 0; i < options.bursts; ++i) {
      SimulatedBurst burst;
      burst.frame = 1 + (last - 1) * (i + rng_.uniform(0.2, 0.8)) / options.bursts;
      burst.x = options.width * rng_.uniform(0.2, 0.8);
      burst.y = options.height * rng_.uniform(0.15, 0.6);
      bursts.push_back(burst);
    }
  }

  std::vector<SimulatedBurst> bursts;
  std::vector<Spark> sparks;

  void advance(int frame) {
    for (Spark& spark : sparks) move(spark, 1);
    std::erase_if(sparks, [](const Spark& spark) { return spark.age >= spark.life; });
    for (std::size_t i = 0; i < bursts.size(); ++i)
      if (std::ceil(bursts[i].frame) == frame) light(bursts[i], static_cast<int>(i), frame);
  }

 private:
  void move(Spark& spark, double frames) {
    spark.x += spark.vx * frames;
    spark.y += spark.vy * frames;
    spark.age += frames;
    spark.vx = options_.persistence * spark.vx + options_.deviation * rng_.normal();
    spark.vy = options_.persistence * spark.vy + options_.gravity + options_.deviation * rng_.normal();
  }

  void light(SimulatedBurst& burst, int idx, int frame) {
    burst.first_track = next_track_;
    burst.num_sparks = std::max(1, static_cast<int>(std::lround(options_.elements * rng_.uniform(0.75, 1.25))));
    const int colour = static_cast<int>(static_cast<std::size_t>(idx) % kColours.size());
    const std::array<double, 3> shade = unit_colour(colour);
    const double brightest = (255 - kSky) / *std::max_element(shade.begin(), shade.end());
    for (int i = 0; i < burst.num_sparks; ++i) {
      Spark spark;
      spark.track = next_track_++;
      spark.x = burst.x;
      spark.y = burst.y;
      const double direction = 2 * std::numbers::pi * rng_.uniform();
      const double speed = std::max(0.15 * options_.speed, options_.speed + options_.spread * rng_.normal());
      spark.vx = speed * std::cos(direction);
      spark.vy = speed * std::sin(direction);
      spark.life = rng_.uniform(options_.min_life, std::max(options_.min_life, options_.max_life));
      spark.size = rng_.uniform(options_.min_size, options_.max_size);
      spark.amplitude = std::min(brightest, options_.amplitude * rng_.uniform(0.8, 1.2));
      spark.colour = colour;
      move(spark, frame - burst.frame);
      sparks.push_back(spark);
    }
  }

  const SimulateFireworksOptions& options_;
  Rng rng_;
  std::int64_t next_track_ = 0;
};

void draw_spark(Planes& planes, const Spark& spark) {
  const double light = spark.brightness(), speed = std::hypot(spark.vx, spark.vy);
  std::array<double, 3> peak = unit_colour(spark.colour);
  for (double& value : peak) value *= light;
  add_blob(planes,
           {spark.x, spark.y, std::hypot(spark.size, 0.6 * speed), spark.size, std::atan2(spark.vy, spark.vx), peak});
}

}  // namespace

SimulatedScene simulate_fireworks(const SimulateFireworksOptions& options) {
  check_options(options);
  if (options.min_size > options.max_size || options.min_life > options.max_life)
    throw InvalidInput("min_size and min_life must not be above max_size and max_life");
  const Planes background(3, Plane(options.width, options.height, static_cast<float>(kSky)));
  SimulatedScene scene = empty_scene(options, background);
  scene.mean_velocity_y = options.gravity / (1 - options.persistence);
  Show show(options);
  std::vector<std::vector<Spark>> shown(static_cast<std::size_t>(options.frames));
  for (int t = 0; t < options.frames; ++t) {
    show.advance(t);
    for (const Spark& spark : show.sparks)
      if (is_inside(spark.x, spark.y, options.width, options.height))
        scene.points.push_back(
            {t, spark.track, spark.x, spark.y, spark.size, std::atan2(spark.vy, spark.vx), spark.brightness(), 0});
    shown[static_cast<std::size_t>(t)] = show.sparks;
  }
  for (const SimulatedBurst& burst : show.bursts)
    if (burst.num_sparks > 0) scene.bursts.push_back(burst);
  draw_frames(scene, background, options.frames, options.noise, options.seed, [&](int t, Planes& planes) {
    for (const Spark& spark : shown[static_cast<std::size_t>(t)]) draw_spark(planes, spark);
  });
  return scene;
}

}  // namespace motex
