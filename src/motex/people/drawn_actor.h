// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "motex/image/image.h"
#include "motex/people/measure_silhouette.h"
#include "motex/people/people_texture.h"
#include "motex/people/sprite.h"

namespace motex {

/// Pose of the drawn actor of the tests: a body with a head, two arms and two legs of round strokes.
struct DrawnPose {
  double x = 100, ground = 190;            ///< middle between the feet and the soles, pixels
  double left_arm = 0.6, right_arm = 0.6;  ///< away from hanging down, radians
  double lean = 0;                         ///< of the upper body to the right, pixels
  double stride = 14;                      ///< from the middle to either foot, pixels
  double lift = 0;                         ///< of the left foot, pixels
  double scale = 1;
  bool has_right_arm = true;
};

/// The pose in a transparent frame of 200 × 200 pixels; edges are soft over a pixel.
inline Sprite drawn_actor(const DrawnPose& pose) {
  Image image(200, 200);
  const auto stroke = [&](double x0, double y0, double x1, double y1, double radius, Rgba colour) {
    const auto film = [&](double x, double y) {
      return std::pair{pose.x + pose.scale * x, pose.ground + pose.scale * y};
    };
    const auto [px, py] = film(x0, y0);
    const auto [qx, qy] = film(x1, y1);
    const int reach = static_cast<int>(pose.scale * radius) + 2;
    const auto first = [&](double p, double q) { return std::max(0, static_cast<int>(std::min(p, q)) - reach); };
    const auto last = [&](double p, double q) { return std::min(199, static_cast<int>(std::max(p, q)) + reach); };
    for (int y = first(py, qy); y <= last(py, qy); ++y) {
      for (int x = first(px, qx); x <= last(px, qx); ++x) {
        const double dx = qx - px, dy = qy - py, square = std::max(1e-9, dx * dx + dy * dy);
        const double along = std::clamp(((x - px) * dx + (y - py) * dy) / square, 0.0, 1.0);
        const double distance = std::hypot(x - px - along * dx, y - py - along * dy);
        const double texture = 0.85 + 0.15 * std::sin(0.9 * (x - px)) * std::sin(0.7 * (y - py));
        const double coverage = std::clamp(pose.scale * radius + 0.5 - distance, 0.0, 1.0);
        if (coverage <= 0) continue;
        const auto lit = [&](std::uint8_t level) { return static_cast<std::uint8_t>(level * texture); };
        blend(image.at(x, y), {lit(colour.r), lit(colour.g), lit(colour.b), 255}, coverage);
      }
    }
  };
  const Rgba skin{220, 170, 140, 255}, shirt{150, 40, 60, 255}, jeans{60, 70, 120, 255};
  const double shoulder_x = pose.lean, shoulder_y = -105;
  stroke(-4, -60, -pose.stride, -4 - pose.lift, 6, jeans);
  stroke(4, -60, pose.stride, -4, 6, jeans);
  const auto arm = [&](double side, double angle) {
    stroke(shoulder_x + side * 14, shoulder_y, shoulder_x + side * (14 + 50 * std::sin(angle)),
           shoulder_y + 50 * std::cos(angle), 4, skin);
  };
  arm(-1, pose.left_arm);
  if (pose.has_right_arm) arm(1, pose.right_arm);
  stroke(0, -65, shoulder_x, shoulder_y + 8, 15, shirt);
  stroke(shoulder_x, shoulder_y - 15, shoulder_x, shoulder_y - 28, 10, skin);
  return sprite_of(image);
}

/// A people texture of one take.
inline PeopleTexture texture_of(const std::vector<Sprite>& sprites) {
  PeopleTexture texture;
  texture.width = texture.height = 200, texture.frames_per_sec = 30;
  texture.takes = {{"drawn", 0, 0, false, {0, static_cast<int>(sprites.size())}}};
  for (const Sprite& sprite : sprites) texture.silhouettes.push_back(measure_silhouette(sprite));
  return texture;
}

}  // namespace motex
