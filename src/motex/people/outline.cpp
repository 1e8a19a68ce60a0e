// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/outline.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/image/contour.h"
#include "motex/image/pyramid.h"

namespace motex {
namespace {

constexpr double kBlur = 1.5;         // pixels: hair and folds of cloth are no shape
constexpr double kInside = 5;         // pixels from the outline to where its colour is taken
constexpr double kProminence = 0.06;  // of the height

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Alpha with a margin, so that blurring does not cut it.
Plane alpha_of(const Sprite& sprite, int margin) {
  Plane alpha(sprite.width + 2 * margin, sprite.height + 2 * margin);
  for (int y = 0; y < sprite.height; ++y)
    for (int x = 0; x < sprite.width; ++x) alpha.at(x + margin, y + margin) = sprite.at(x, y)[3];
  return alpha;
}

double length_of(const Contour& contour) {
  double sum = 0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const ContourPoint a = contour[i], b = contour[(i + 1) % contour.size()];
    sum += std::hypot(b.x - a.x, b.y - a.y);
  }
  return sum;
}

std::vector<ContourPoint> resampled(const Contour& contour, int num_points) {
  const double step = length_of(contour) / num_points;
  std::vector<ContourPoint> points;
  double walked = 0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const ContourPoint a = contour[i], b = contour[(i + 1) % contour.size()];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    while (static_cast<int>(points.size()) < num_points &&
           static_cast<double>(points.size()) * step < walked + length) {
      const double share = (static_cast<double>(points.size()) * step - walked) / length;
      points.push_back({a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share});
    }
    walked += length;
  }
  while (static_cast<int>(points.size()) < num_points) points.push_back(contour.back());
  return points;
}

std::array<float, 3> colour_at(const Sprite& sprite, double x, double y) {
  const int px = std::clamp(static_cast<int>(std::lround(x)), 0, sprite.width - 1);
  const int py = std::clamp(static_cast<int>(std::lround(y)), 0, sprite.height - 1);
  std::array<float, 3> sum{};
  for (int v = std::max(0, py - 1); v <= std::min(sprite.height - 1, py + 1); ++v)
    for (int u = std::max(0, px - 1); u <= std::min(sprite.width - 1, px + 1); ++u)
      for (std::size_t c = 0; c < 3; ++c) sum[c] += static_cast<float>(sprite.at(u, v)[c]) / 9;
  return sum;
}

std::vector<int> find_tips(const Outline& outline) {
  const int n = outline.size();
  double x = 0, y = 0;
  for (const OutlinePoint& point : outline.points) x += point.x / n, y += point.y / n;
  std::vector<double> distance;
  for (int i = 0; i < n; ++i) {
    const OutlinePoint &a = outline.point(i - 1), &b = outline.point(i), &c = outline.point(i + 1);
    distance.push_back(std::hypot((a.x + 2 * b.x + c.x) / 4 - x, (a.y + 2 * b.y + c.y) / 4 - y));
  }
  const auto value = [&](int i) { return distance[at(((i % n) + n) % n)]; };
  // How deep it goes down on the way to somewhere higher.
  const auto dip = [&](int i, int direction) {
    double lowest = value(i);
    for (int k = 1; k < n && value(i + direction * k) <= value(i); ++k)
      lowest = std::min(lowest, value(i + direction * k));
    return value(i) - lowest;
  };
  std::vector<int> tips;
  for (int i = 0; i < n; ++i)
    if (value(i) > value(i - 1) && value(i) >= value(i + 1) &&
        std::min(dip(i, 1), dip(i, -1)) >= kProminence * outline.height)
      tips.push_back(i);
  return tips;
}

}  // namespace

const OutlinePoint& Outline::point(int i) const { return points[at(((i % size()) + size()) % size())]; }

OutlinePoint point_between(const Outline& outline, double place) {
  const double whole = std::floor(place), share = place - whole;
  const OutlinePoint& a = outline.point(static_cast<int>(whole));
  const OutlinePoint& b = outline.point(static_cast<int>(whole) + 1);
  OutlinePoint out = a;
  out.x += (b.x - a.x) * share, out.y += (b.y - a.y) * share;
  out.normal_x += (b.normal_x - a.normal_x) * share, out.normal_y += (b.normal_y - a.normal_y) * share;
  return out;
}

Outline outline_of(const PlacedSprite& placed, int num_points) {
  if (num_points < 8) throw InvalidInput("an outline needs at least 8 points");
  const Sprite& sprite = placed.sprite;
  Outline outline;
  if (sprite.empty()) return outline;
  const int margin = 6;
  const std::vector<Contour> found = contours(gaussian_blur(alpha_of(sprite, margin), kBlur), 127.5F);
  const auto largest = std::max_element(
      found.begin(), found.end(), [](const Contour& a, const Contour& b) { return signed_area(a) < signed_area(b); });
  if (largest == found.end() || signed_area(*largest) < 16) return outline;
  const std::vector<ContourPoint> points = resampled(*largest, num_points);
  const double scale = placed.placement.scale;
  outline.step = length_of(*largest) / num_points * scale;
  outline.height = sprite.height * scale;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContourPoint& before = points[(i + points.size() - 1) % points.size()];
    const ContourPoint& after = points[(i + 1) % points.size()];
    const double dx = after.x - before.x, dy = after.y - before.y, length = std::max(1e-9, std::hypot(dx, dy));
    OutlinePoint point;
    point.normal_x = dy / length, point.normal_y = -dx / length;  // clockwise as seen: the inside is on the right
    const double x = points[i].x - margin, y = points[i].y - margin;
    point.colour = colour_at(sprite, x - kInside * point.normal_x, y - kInside * point.normal_y);
    point.x = (x + sprite.left) * scale + placed.placement.x, point.y = (y + sprite.top) * scale + placed.placement.y;
    outline.points.push_back(point);
  }
  outline.tips = find_tips(outline);
  return outline;
}

}  // namespace motex
