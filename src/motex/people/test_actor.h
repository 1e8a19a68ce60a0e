// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "motex/core/rng.h"
#include "motex/people/measure_silhouette.h"
#include "motex/people/people_texture.h"
#include "motex/people/sprite.h"

/// For tests: an actor of six sticks who stands, raises an arm ("A"), kicks ("B") or squats ("C"), each action 30
/// frames long and a little different every time.
namespace motex::test_actor {

struct Pose {
  double arm = 0, leg = 0, squat = 0;  ///< 0 = at rest, 1 = at the height of the action
  double x = 48;                       ///< of the hips, pixels
};

constexpr int kWidth = 96, kHeight = 96, kActionFrames = 30, kRestFrames = 24;

inline double distance_to_stick(double x, double y, double ax, double ay, double bx, double by) {
  const double dx = bx - ax, dy = by - ay;
  const double t = std::clamp(((x - ax) * dx + (y - ay) * dy) / std::max(dx * dx + dy * dy, 1e-9), 0.0, 1.0);
  return std::hypot(x - ax - t * dx, y - ay - t * dy);
}

inline Sprite draw(const Pose& pose) {
  const double hips = 56 + 10 * pose.squat, neck = hips - 26, foot = 86;
  const double arm = 0.3 + 2.2 * pose.arm, leg = 0.15 + 1.5 * pose.leg;
  struct Stick {
    double ax, ay, bx, by, radius;
    int r, g, b;
  };
  const std::vector<Stick> sticks{
      {pose.x, hips, pose.x, neck, 5, 40, 60, 160},
      {pose.x, neck - 8, pose.x, neck - 8, 6, 230, 180, 150},
      {pose.x, neck + 2, pose.x + 22 * std::sin(arm), neck + 2 + 22 * std::cos(arm), 2.5, 200, 150, 120},
      {pose.x, neck + 2, pose.x - 9, neck + 22, 2.5, 180, 130, 100},
      {pose.x, hips, pose.x + 29 * std::sin(leg), std::min(foot, hips + 30 * std::cos(leg)), 3, 60, 60, 60},
      {pose.x, hips, pose.x - 7 - 6 * pose.squat, foot, 3, 50, 50, 50}};
  Sprite sprite{0, 0, kWidth, kHeight, std::vector<PremultipliedRgba>(std::size_t{kWidth} * kHeight)};
  const auto low = [](double a, double b, double radius) {
    return std::max(0, static_cast<int>(std::min(a, b) - radius - 1));
  };
  const auto high = [](double a, double b, double radius) {
    return std::min(kWidth - 1, static_cast<int>(std::max(a, b) + radius + 2));
  };
  for (const Stick& s : sticks)
    for (int y = low(s.ay, s.by, s.radius); y <= high(s.ay, s.by, s.radius); ++y)
      for (int x = low(s.ax, s.bx, s.radius); x <= high(s.ax, s.bx, s.radius); ++x) {
        const double alpha = std::clamp(s.radius + 0.5 - distance_to_stick(x, y, s.ax, s.ay, s.bx, s.by), 0.0, 1.0);
        const auto level = [&](int colour) { return static_cast<std::uint8_t>(std::lround(alpha * colour)); };
        if (level(255) > sprite.at(x, y)[3]) sprite.at(x, y) = {level(s.r), level(s.g), level(s.b), level(255)};
      }
  return sprite;
}

/// Footage, what is in it, and its pictures.
struct Footage {
  PeopleTexture texture;
  std::vector<Sprite> sprites;
};

/// Adds a take that performs the letters, rests between them; '-' = one more rest.
inline void add_take(Footage& footage, const std::string& actions, Rng& rng) {
  PeopleTexture& texture = footage.texture;
  const int start = texture.num_frames();
  const auto add = [&](const Pose& pose) {
    footage.sprites.push_back(draw(pose));
    texture.silhouettes.push_back(measure_silhouette(footage.sprites.back()));
  };
  const auto rest = [&] {
    texture.alphabet.idle.push_back({texture.num_frames(), kRestFrames});
    for (int t = 0; t < kRestFrames; ++t)
      add({0.02 * std::sin(0.4 * texture.num_frames()), 0, 0, 48 + 0.2 * std::sin(0.23 * texture.num_frames())});
  };
  rest();
  for (const char action : actions) {
    if (action != '-') {
      Motif& motif = texture.alphabet.motifs[static_cast<std::size_t>(action - 'A')];
      motif.occurrences.push_back({texture.num_frames(), kActionFrames, 0});
      const double height = 1 + 0.04 * rng.normal();
      for (int t = 0; t < kActionFrames; ++t) {
        const double swing = height * 0.5 * (1 - std::cos(2 * std::numbers::pi * (t + 0.5) / kActionFrames));
        add({action == 'A' ? swing : 0, action == 'B' ? swing : 0, action == 'C' ? swing : 0, 48});
      }
    }
    rest();
  }
  Take take;
  take.source = "take " + std::to_string(texture.takes.size());
  take.frames = {start, texture.num_frames() - start};
  texture.takes.push_back(take);
}

inline Footage make_footage(const std::vector<std::string>& takes, std::uint64_t seed = 1) {
  Footage footage;
  PeopleTexture& texture = footage.texture;
  texture.width = kWidth, texture.height = kHeight, texture.frames_per_sec = 25;
  for (const auto& [letter, name] : {std::pair{"A", "raise"}, {"B", "high kick"}, {"C", "squat"}}) {
    Motif& motif = texture.alphabet.motifs.emplace_back();
    motif.letter = letter, motif.name = name, motif.window = kActionFrames;
  }
  Rng rng(seed);
  for (const std::string& actions : takes) add_take(footage, actions, rng);
  return footage;
}

}  // namespace motex::test_actor
