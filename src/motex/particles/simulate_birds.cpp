// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/core/rng.h"
#include "motex/particles/simulate.h"
#include "motex/particles/simulated_picture.h"

namespace motex {
namespace {

constexpr int kPaths = 2;                                     // streams of the generator
constexpr std::array<double, 3> kWingLift{0.85, 0.12, -0.7};  // radians above the body: up, level, down
constexpr std::array<double, 3> kFeathers{0.96, 1.0, 1.06};   // colour of the birds' darkness: R, G, B

struct Bird {
  std::int64_t track = 0;
  double x = 0, y = 0, vx = 0, vy = 0;
  double size = 1, amplitude = 0;
  int state = 0;
};

struct Group {
  double x = 0, y = 0, vx = 0, vy = 0;
  std::vector<Bird> birds;
};

TransitionMatrix wing_matrix(double stay) {
  const double go = 1 - stay;
  const std::array<std::array<double, 3>, 3> rows{
      {{stay, 0.85 * go, 0.15 * go}, {0.4 * go, stay, 0.6 * go}, {0.1 * go, 0.9 * go, stay}}};
  TransitionMatrix matrix(3);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double probability = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      if (probability > 0) matrix.add_count(i, j, probability);
    }
  return matrix;
}

class Flight {
 public:
  Flight(const SimulateBirdsOptions& options, const TransitionMatrix& wings)
      : options_(options),
        wings_(wings),
        reach_(5 * options.max_size * std::sqrt(options.group_size)),
        margin_(2 * reach_ + 6 * options.max_size),
        density_(options.elements / (options.group_size * options.width * options.height)),
        rng_(Rng(options.seed).fork(kPaths)) {
    add_groups([](const Group&) { return true; });
  }

  const std::vector<Group>& groups() const { return groups_; }

  void advance() {
    for (Group& group : groups_) {
      group.x += group.vx;
      group.y += group.vy;
      for (Bird& bird : group.birds) {
        bird.vx = group.vx + options_.persistence * (bird.vx - group.vx) + options_.deviation * rng_.normal();
        bird.vy = group.vy + options_.persistence * (bird.vy - group.vy) + options_.deviation * rng_.normal();
        bird.x += bird.vx;
        bird.y += bird.vy;
        bird.state = next_state(bird.state);
      }
    }
    std::erase_if(groups_, [&](const Group& group) { return !near(group.x, group.y); });
    add_groups([&](const Group& group) { return !near(group.x - group.vx, group.y - group.vy); });
  }

 private:
  bool near(double x, double y) const {
    return x >= -margin_ && y >= -margin_ && x < options_.width + margin_ && y < options_.height + margin_;
  }
  int next_state(int state) {
    double left = rng_.uniform();
    for (int next = 0; next < 2; ++next) {
      left -= wings_.probability(state, next);
      if (left < 0) return next;
    }
    return wings_.probability(state, 2) > 0 ? 2 : state;
  }

  /// As many as there would be in an even sky, of those that `accept` takes.
  template <typename Accept>
  void add_groups(const Accept& accept) {
    const int num = draw_poisson(rng_, density_ * (options_.width + 2 * margin_) * (options_.height + 2 * margin_));
    for (int i = 0; i < num; ++i) {
      Group group = fresh();
      if (!accept(group)) continue;
      for (Bird& bird : group.birds) bird.track = next_track_++;
      groups_.push_back(std::move(group));
    }
  }

  Group fresh() {
    Group group;
    group.x = rng_.uniform(-margin_, options_.width + margin_);
    group.y = rng_.uniform(-margin_, options_.height + margin_);
    group.vx = options_.wind + options_.spread * rng_.normal();
    group.vy = -options_.rise + options_.spread * rng_.normal();
    const double steady = options_.deviation / std::sqrt(1 - options_.persistence * options_.persistence);
    const int num = 1 + draw_poisson(rng_, options_.group_size - 1);
    for (int i = 0; i < num; ++i) {
      Bird bird;
      bird.x = group.x + rng_.uniform(-reach_, reach_);
      bird.y = group.y + rng_.uniform(-reach_, reach_);
      bird.vx = group.vx + steady * rng_.normal();
      bird.vy = group.vy + steady * rng_.normal();
      bird.size = rng_.uniform(options_.min_size, options_.max_size);
      bird.amplitude = rng_.uniform(options_.min_amplitude, options_.max_amplitude);
      bird.state = static_cast<int>(rng_.below(3));
      for (int k = 0; k < 8; ++k) bird.state = next_state(bird.state);  // forgets how it began
      group.birds.push_back(bird);
    }
    return group;
  }

  const SimulateBirdsOptions& options_;
  const TransitionMatrix& wings_;
  double reach_, margin_, density_;
  Rng rng_;
  std::int64_t next_track_ = 0;
  std::vector<Group> groups_;
};

/// Lighter towards the horizon.
Planes sky(int width, int height) {
  constexpr std::array<double, 3> kTop{120, 160, 215}, kBottom{190, 210, 235};
  Planes planes;
  for (std::size_t k = 0; k < 3; ++k) {
    Plane& plane = planes.emplace_back(width, height);
    for (int y = 0; y < height; ++y)
      std::fill_n(plane.row(y), width, static_cast<float>(kTop[k] + (kBottom[k] - kTop[k]) * (y + 0.5) / height));
  }
  return planes;
}

/// Heading of a bird, seen from beside: its body leans as it climbs, never more than half a right angle.
double lean(const Bird& bird) {
  return std::clamp(std::atan2(bird.vy, std::max(std::abs(bird.vx), 1e-6)), -0.78, 0.78) * (bird.vx < 0 ? -1 : 1);
}

void draw_bird(Planes& planes, const Bird& bird) {
  const double angle = lean(bird);
  std::array<double, 3> dark{};
  for (std::size_t k = 0; k < 3; ++k) dark[k] = -bird.amplitude * kFeathers[k];
  add_blob(planes, {bird.x, bird.y, 1.6 * bird.size, bird.size, angle, dark});
  for (double& value : dark) value *= 0.8;
  const double lift = kWingLift[static_cast<std::size_t>(bird.state)];
  for (const double side : {-1.0, 1.0}) {
    const double wing = angle - side * lift;  // y points down
    const double arm = side * 2.6 * bird.size;
    add_blob(planes, {bird.x + arm * std::cos(wing), bird.y + arm * std::sin(wing), 1.7 * bird.size, 0.5 * bird.size,
                      wing, dark});
  }
}

}  // namespace

SimulatedScene simulate_birds(const SimulateBirdsOptions& options) {
  check_options(options);
  if (options.min_size > options.max_size || options.min_amplitude > options.max_amplitude)
    throw InvalidInput("min_size and min_amplitude must not be above max_size and max_amplitude");
  const Planes background = sky(options.width, options.height);
  SimulatedScene scene = empty_scene(options, background);
  scene.mean_velocity_x = options.wind;
  scene.mean_velocity_y = -options.rise;
  scene.wing_transitions = wing_matrix(options.stay);
  Flight flight(options, scene.wing_transitions);
  std::vector<std::vector<Bird>> shown(static_cast<std::size_t>(options.frames));
  for (int t = 0; t < options.frames; ++t) {
    if (t > 0) flight.advance();
    std::vector<Bird>& birds = shown[static_cast<std::size_t>(t)];
    for (const Group& group : flight.groups()) birds.insert(birds.end(), group.birds.begin(), group.birds.end());
    for (const Bird& bird : birds)
      if (is_inside(bird.x, bird.y, options.width, options.height))
        scene.points.push_back({t, bird.track, bird.x, bird.y, bird.size, lean(bird), -bird.amplitude, bird.state});
  }
  draw_frames(scene, background, options.frames, options.noise, options.seed, [&](int t, Planes& planes) {
    for (const Bird& bird : shown[static_cast<std::size_t>(t)]) draw_bird(planes, bird);
  });
  return scene;
}

}  // namespace motex
