// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/carried_placement.h"

#include <algorithm>
#include <cmath>

namespace motex {
namespace {

constexpr double kGround = 0.06;          // of the height
constexpr double kSame = 0.85;            // share of a foot's pixels
constexpr double kStill = 0.0015;         // of the height a frame
constexpr double kUnseen = 0.0003;        // of the height a frame
constexpr double kFastest = 0.004;        // of the height a frame
constexpr double kAcceleration = 0.0004;  // of the height a frame²
constexpr double kUnseenScale = 0.0005;   // a frame
constexpr double kReturn = 0.03;          // a frame, of what is held outside the picture
constexpr std::uint8_t kHalf = 128;

/// Pixels of `sprite` at a place of the frame.
std::uint8_t alpha_at(const Sprite& sprite, int x, int y) {
  x -= sprite.left, y -= sprite.top;
  return x >= 0 && y >= 0 && x < sprite.width && y < sprite.height ? sprite.at(x, y)[3] : std::uint8_t{0};
}

/// The lowest row with a pixel of alpha ≥ ½, or none.
std::optional<int> lowest_row(const Sprite& sprite) {
  for (int y = sprite.height - 1; y >= 0; --y)
    for (int x = 0; x < sprite.width; ++x)
      if (sprite.at(x, y)[3] >= kHalf) return sprite.top + y;
  return std::nullopt;
}

struct FootChange {
  double both = 0, either = 0;           // pixels
  double now = 0, now_x = 0, now_y = 0;  // pixels, sums of places
  double then = 0, then_x = 0, then_y = 0;

  bool still(double height) const {
    return now > 0 && then > 0 && both >= kSame * either &&
           std::hypot(now_x / now - then_x / then, now_y / now - then_y / then) <= kStill * height;
  }
};

FootChange compare_foot(const Sprite& before, const Sprite& now, int left, int right, int top, int bottom) {
  FootChange change;
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const bool in_now = alpha_at(now, x, y) >= kHalf, in_before = alpha_at(before, x, y) >= kHalf;
      change.both += in_now && in_before, change.either += in_now || in_before;
      if (in_now) ++change.now, change.now_x += x, change.now_y += y;
      if (in_before) ++change.then, change.then_x += x, change.then_y += y;
    }
  }
  return change;
}

double towards(double value, double goal, double most) { return value + std::clamp(goal - value, -most, most); }

}  // namespace

std::optional<Footing> footing_of(const Sprite& sprite) {
  const std::optional<int> lowest = lowest_row(sprite);
  if (!lowest) return std::nullopt;
  const int top = *lowest - static_cast<int>(kGround * sprite.height);
  double x = 0, count = 0;
  for (int v = top; v <= *lowest; ++v)
    for (int u = sprite.left; u < sprite.left + sprite.width; ++u)
      if (alpha_at(sprite, u, v) >= kHalf) x += u, ++count;
  return Footing{x / count, static_cast<double>(*lowest), static_cast<double>(sprite.height)};
}

bool stands_still(const Sprite& before, const Sprite& now) {
  const std::optional<int> lowest = lowest_row(now);
  if (!lowest) return false;
  const int band = std::max(2, static_cast<int>(kGround * now.height));
  const int top = *lowest - band + 1, bottom = *lowest + 2;
  // Feet: runs of columns with something in the band.
  int start = -1;
  for (int x = now.left; x <= now.left + now.width; ++x) {
    bool any = false;
    for (int y = top; y <= *lowest && !any; ++y) any = alpha_at(now, x, y) >= kHalf;
    if (any && start < 0) start = x;
    if (any || start < 0) continue;
    if (compare_foot(before, now, start - 3, x + 2, top, bottom).still(now.height)) return true;
    start = -1;
  }
  return false;
}

void CarriedPlacement::set(const Sprite& sprite, const Placement& placement) {
  const Footing feet = footing_of(sprite).value_or(Footing{});
  scale_ = placement.scale;
  x_ = (placement.scale - 1) * feet.x + placement.x;
  y_ = (placement.scale - 1) * feet.y + placement.y;
  speed_ = 0;
}

void CarriedPlacement::aim(double x, double y, double scale, int num_frames) {
  aim_x_ = x, aim_y_ = y, aim_scale_ = scale;
  frames_left_ = num_frames;
}

Placement CarriedPlacement::placement_of(const Sprite& sprite) const {
  const Footing feet = footing_of(sprite).value_or(Footing{});
  return {scale_, x_ + (1 - scale_) * feet.x, y_ + (1 - scale_) * feet.y};
}

/// Pixels by which the offset takes the sprite over the frame's edges, beyond where the footage has it.
double CarriedPlacement::outside(const Sprite& sprite) const {
  const BoundingBox there = box_of(sprite, placement_of(sprite)), own = box_of(sprite);
  const auto excess = [](int placed, int home) { return std::max(0, placed - std::max(0, home)); };
  return std::max({excess(-there.left, -own.left), excess(there.right - width_ + 1, own.right - width_ + 1),
                   excess(-there.top, -own.top), excess(there.bottom - height_ + 1, own.bottom - height_ + 1)});
}

Placement CarriedPlacement::next(const Sprite* before, const Sprite& now) {
  const double way_x = aim_x_ - x_, way_y = aim_y_ - y_, way = std::hypot(way_x, way_y);
  if ((way > 0 || scale_ != aim_scale_) && before != nullptr && !now.empty()) {
    const double height = now.height;
    const bool planted = stands_still(*before, now);
    const double braking = std::sqrt(2 * kAcceleration * height * way);
    const double wanted = planted ? kUnseen * height : std::min(kFastest * height, braking);
    speed_ = planted ? wanted : std::min(speed_ + kAcceleration * height, std::max(wanted, kUnseen * height));
    double step = speed_ + kReturn * outside(now), scale_step = kUnseenScale;
    if (frames_left_ > 0) {
      step = std::max(step, way / frames_left_);
      scale_step = std::max(scale_step, std::abs(aim_scale_ - scale_) / frames_left_);
      --frames_left_;
    }
    const double share = way > 0 ? std::min(1.0, step / way) : 1;
    x_ = share == 1 ? aim_x_ : x_ + share * way_x;
    y_ = share == 1 ? aim_y_ : y_ + share * way_y;
    scale_ = towards(scale_, aim_scale_, scale_step);
  }
  return placement_of(now);
}

}  // namespace motex
