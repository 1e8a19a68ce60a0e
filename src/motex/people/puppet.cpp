// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/puppet.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "motex/core/error.h"

namespace motex {
namespace {

using J = PuppetJoint;

struct Vec {
  double x = 0, y = 0;
};
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y; }

/// Between two discs.
struct Capsule {
  Vec a, b;
  double radius_a = 0, radius_b = 0;  // pixels

  /// Where the nearest point of the axis lies, 0 … 1, and how far the outline is (inside: below 0).
  std::pair<double, double> measure(Vec p) const {
    const Vec axis{b.x - a.x, b.y - a.y}, to{p.x - a.x, p.y - a.y};
    const double squared = dot(axis, axis);
    const double t = squared > 0 ? std::clamp(dot(to, axis) / squared, 0.0, 1.0) : 0;
    return {t, std::hypot(to.x - t * axis.x, to.y - t * axis.y) - (radius_a + t * (radius_b - radius_a))};
  }
};

/// What has one colour and one depth.
struct Part {
  std::array<Capsule, 3> capsules;
  int num_capsules = 1;
  Rgba colour, stripes, below;  // below: under the trunk's waist
  double depth = 0;
  bool is_trunk = false;
};

constexpr double kLamp[3] = {-0.42, -0.54, 0.73};
constexpr double kAmbient = 0.5;
constexpr double kWaist = 0.87;  // of the way from neck to pelvis

/// Brightness of a rounded surface whose normal leans by (x, y) in the picture.
double brightness(double x, double y) {
  const double z = std::sqrt(std::max(0.0, 1 - x * x - y * y));
  return kAmbient + (1.05 - kAmbient) * std::max(0.0, kLamp[0] * x + kLamp[1] * y + kLamp[2] * z);
}

struct Shade {
  double distance;
  std::array<float, 3> colour;
};

std::array<float, 3> lit(Rgba colour, double light) {
  return {static_cast<float>(colour.r * light), static_cast<float>(colour.g * light),
          static_cast<float>(colour.b * light)};
}

Shade shade_limb(const Part& part, Vec p) {
  const Capsule& limb = part.capsules[0];
  const auto [t, distance] = limb.measure(p);
  const double radius = std::max(0.5, limb.radius_a + t * (limb.radius_b - limb.radius_a));
  const Vec from{p.x - limb.a.x - t * (limb.b.x - limb.a.x), p.y - limb.a.y - t * (limb.b.y - limb.a.y)};
  const double scale = 1 / std::max(radius, radius + distance);
  return {distance, lit(part.colour, brightness(from.x * scale, from.y * scale))};
}

/// The trunk: both sides and the spine, stripes across, light over the whole width.
Shade shade_trunk(const Part& part, Vec p) {
  double distance = 1e9;
  for (const Capsule& capsule : part.capsules) distance = std::min(distance, capsule.measure(p).second);
  const Capsule& spine = part.capsules[0];
  const Vec axis{spine.b.x - spine.a.x, spine.b.y - spine.a.y};
  const double length = std::max(1.0, std::hypot(axis.x, axis.y));
  const Vec along{axis.x / length, axis.y / length}, across{-along.y, along.x};
  const Vec to{p.x - spine.a.x, p.y - spine.a.y};
  double half = spine.radius_a;
  for (const Capsule& capsule : part.capsules)
    half = std::max(half, std::abs(dot({capsule.a.x - spine.a.x, capsule.a.y - spine.a.y}, across)) + capsule.radius_a);
  const double u = std::clamp(dot(to, across) / half, -1.0, 1.0) * 0.9;
  const double down = dot(to, along) / length, stripe = down * 4.5 + 0.25;
  const Rgba colour = down > kWaist ? part.below : stripe - std::floor(stripe) < 0.3 ? part.stripes : part.colour;
  return {distance, lit(colour, brightness(u * across.x, u * across.y))};
}

class PartList {
 public:
  PartList(const PuppetPose& pose, const PuppetLook& look) : pose_(pose), look_(look) {
    trunk();
    limb(J::kNeck, J::kHead, 0.055, 0.05, look.skin);
    limb(J::kHead, J::kHead, 0.115, 0.115, look.hair);
    limb(J::kFace, J::kFace, 0.088, 0.088, look.skin);
    arm(J::kLeftShoulder, J::kLeftElbow, J::kLeftWrist, J::kLeftFingers);
    arm(J::kRightShoulder, J::kRightElbow, J::kRightWrist, J::kRightFingers);
    leg(J::kLeftHip, J::kLeftKnee, J::kLeftAnkle, J::kLeftToes);
    leg(J::kRightHip, J::kRightKnee, J::kRightAnkle, J::kRightToes);
    std::stable_sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) { return a.depth > b.depth; });
  }
  const std::vector<Part>& parts() const { return parts_; }

 private:
  Capsule capsule(J from, J to, double metres_a, double metres_b) const {
    const PuppetPoint &a = pose_.at(from), &b = pose_.at(to);
    return {{a.x, a.y},
            {b.x, b.y},
            metres_a * look_.girth * a.pixels_per_metre,
            metres_b * look_.girth * b.pixels_per_metre};
  }
  void limb(J from, J to, double metres_a, double metres_b, Rgba colour) {
    Part& part = parts_.emplace_back();
    part.capsules[0] = capsule(from, to, metres_a, metres_b);
    part.colour = colour;
    part.depth = 0.5 * (pose_.at(from).depth_metres + pose_.at(to).depth_metres);
  }
  void trunk() {
    Part& part = parts_.emplace_back();
    part.num_capsules = 3;
    part.capsules = {capsule(J::kNeck, J::kPelvis, 0.10, 0.13), capsule(J::kLeftShoulder, J::kLeftHip, 0.075, 0.10),
                     capsule(J::kRightShoulder, J::kRightHip, 0.075, 0.10)};
    part.colour = look_.shirt;
    part.stripes = look_.stripes;
    part.below = look_.trousers;
    part.depth = 0.5 * (pose_.at(J::kNeck).depth_metres + pose_.at(J::kPelvis).depth_metres);
    part.is_trunk = true;
  }
  void arm(J shoulder, J elbow, J wrist, J fingers) {
    limb(wrist, fingers, 0.034, 0.03, look_.skin);
    limb(elbow, wrist, 0.044, 0.032, look_.skin);
    limb(shoulder, elbow, 0.062, 0.052, look_.shirt);
  }
  void leg(J hip, J knee, J ankle, J toes) {
    limb(ankle, toes, 0.052, 0.042, look_.shoes);
    limb(knee, ankle, 0.066, 0.05, look_.trousers);
    limb(hip, knee, 0.095, 0.07, look_.trousers);
  }

  const PuppetPose& pose_;
  const PuppetLook& look_;
  std::vector<Part> parts_;
};

struct Area {
  int left, top, right, bottom;  // all inside
};

Area area_of(const Part& part, int width, int height) {
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
  for (int k = 0; k < part.num_capsules; ++k) {
    const Capsule& c = part.capsules[static_cast<std::size_t>(k)];
    const double reach = std::max(c.radius_a, c.radius_b) + 1;
    left = std::min({left, c.a.x - reach, c.b.x - reach});
    top = std::min({top, c.a.y - reach, c.b.y - reach});
    right = std::max({right, c.a.x + reach, c.b.x + reach});
    bottom = std::max({bottom, c.a.y + reach, c.b.y + reach});
  }
  const auto whole = [](double v, int most) { return static_cast<int>(std::clamp(std::floor(v), -1.0, most + 0.0)); };
  return {std::max(0, whole(left, width)), std::max(0, whole(top, height)), std::min(width - 1, whole(right, width)),
          std::min(height - 1, whole(bottom, height))};
}

/// One pixel while parts are laid over one another.
struct Cell {
  float distance = 1e9F, cover = 0;
  std::array<float, 3> light{};  // colour times cover
};

void lay_over(const Part& part, const Area& area, const Area& whole, std::vector<Cell>& cells) {
  const int stride = whole.right - whole.left + 1;
  for (int y = area.top; y <= area.bottom; ++y) {
    Cell* row = &cells[static_cast<std::size_t>(y - whole.top) * static_cast<std::size_t>(stride)] - whole.left;
    for (int x = area.left; x <= area.right; ++x) {
      const Vec p{x + 0.0, y + 0.0};
      const Shade shade = part.is_trunk ? shade_trunk(part, p) : shade_limb(part, p);
      if (shade.distance >= 0.5) continue;
      Cell& cell = row[x];
      const float cover = static_cast<float>(std::min(1.0, 0.5 - shade.distance));
      cell.distance = std::min(cell.distance, static_cast<float>(shade.distance));
      cell.cover = cover + (1 - cover) * cell.cover;
      for (std::size_t k = 0; k < 3; ++k) cell.light[k] = cover * shade.colour[k] + (1 - cover) * cell.light[k];
    }
  }
}

PremultipliedRgba finished(const Cell& cell, const SpillLight& spill) {
  if (cell.cover <= 0) return {};
  const float alpha = std::clamp(0.5F - cell.distance, 0.0F, 1.0F);
  const auto whole = static_cast<std::uint8_t>(std::lround(255 * alpha));
  const double amount =
      spill.amount <= 0 ? 0 : spill.amount * std::exp(std::min(0.0F, cell.distance) / spill.reach_pixels);
  const std::array<double, 3> screen{spill.colour.r + 0.0, spill.colour.g + 0.0, spill.colour.b + 0.0};
  PremultipliedRgba out{0, 0, 0, whole};
  for (std::size_t k = 0; k < 3; ++k) {
    const double colour = std::min(255.0, static_cast<double>(cell.light[k] / cell.cover));
    const double seen = ((1 - amount) * colour + amount * screen[k]) * whole / 255;
    out[k] = std::min(whole, static_cast<std::uint8_t>(std::lround(seen)));
  }
  return out;
}

}  // namespace

PuppetLook puppet_look(int number) {
  static const std::array<PuppetLook, 4> kLooks{{{},
                                                 {{190, 130, 96, 255},
                                                  {24, 20, 22, 255},
                                                  {232, 186, 70, 255},
                                                  {120, 40, 30, 255},
                                                  {92, 88, 96, 255},
                                                  {150, 40, 40, 255},
                                                  0.93},
                                                 {{240, 200, 176, 255},
                                                  {170, 96, 40, 255},
                                                  {96, 70, 130, 255},
                                                  {214, 150, 180, 255},
                                                  {30, 30, 36, 255},
                                                  {120, 80, 50, 255},
                                                  1.08},
                                                 {{120, 78, 56, 255},
                                                  {18, 16, 16, 255},
                                                  {214, 206, 196, 255},
                                                  {190, 70, 40, 255},
                                                  {120, 92, 66, 255},
                                                  {220, 216, 210, 255},
                                                  1.0}}};
  return kLooks[static_cast<std::size_t>(((number % 4) + 4) % 4)];
}

Sprite draw_puppet(const PuppetPose& pose, const PuppetLook& look, int width, int height, const SpillLight& spill) {
  if (width < 1 || height < 1 || width > 32768 || height > 32768)
    throw InvalidInput("a puppet's frame is of 1 … 32768 pixels a side");
  const PartList list(pose, look);
  std::vector<Area> areas;
  Area whole{width, height, -1, -1};
  for (const Part& part : list.parts()) {
    const Area area = areas.emplace_back(area_of(part, width, height));
    if (area.right < area.left || area.bottom < area.top) continue;
    whole = {std::min(whole.left, area.left), std::min(whole.top, area.top), std::max(whole.right, area.right),
             std::max(whole.bottom, area.bottom)};
  }
  Sprite sprite;
  if (whole.right < whole.left || whole.bottom < whole.top) return sprite;
  sprite.left = whole.left;
  sprite.top = whole.top;
  sprite.width = whole.right - whole.left + 1;
  sprite.height = whole.bottom - whole.top + 1;
  std::vector<Cell> cells(static_cast<std::size_t>(sprite.width) * static_cast<std::size_t>(sprite.height));
  for (std::size_t k = 0; k < areas.size(); ++k) lay_over(list.parts()[k], areas[k], whole, cells);
  sprite.pixels.reserve(cells.size());
  for (const Cell& cell : cells) sprite.pixels.push_back(finished(cell, spill));
  return sprite;
}

}  // namespace motex
