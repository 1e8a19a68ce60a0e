// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/plot/coverage.h"

#include <algorithm>
#include <cmath>

namespace motex {
namespace {

double signed_area(std::span<const Point> points) {
  double twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point a = points[i], b = points[(i + 1) % points.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

Rgba colour_at(const Paint& paint, double x, double y) {
  if (paint.stops.empty()) return paint.colour;
  const double dx = paint.to.x - paint.from.x, dy = paint.to.y - paint.from.y;
  const double length2 = dx * dx + dy * dy;
  const double share = length2 > 0 ? ((x - paint.from.x) * dx + (y - paint.from.y) * dy) / length2 : 0;
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(paint.stops.size() - 1);
  const auto idx = std::min(static_cast<std::size_t>(at), paint.stops.size() - 2);
  return mix(paint.stops[idx], paint.stops[idx + 1], at - static_cast<double>(idx));
}

}  // namespace

Coverage::Coverage(int width, int height)
    : width_(width),
      height_(height),
      first_row_(height),
      area_(static_cast<std::size_t>(height) * static_cast<std::size_t>(width + 2), 0.F) {}

void Coverage::add_outline(std::span<const Point> points) {
  const double sign = signed_area(points) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < points.size(); ++i) add_edge(points[i], points[(i + 1) % points.size()], sign);
}

void Coverage::add_edge(Point from, Point to, double sign) {
  if (!(std::isfinite(from.x) && std::isfinite(from.y) && std::isfinite(to.x) && std::isfinite(to.y))) return;
  if (from.y == to.y) return;
  if (from.y > to.y) {
    std::swap(from, to);
    sign = -sign;
  }
  const double slope = (to.x - from.x) / (to.y - from.y);
  const double top = std::clamp(from.y, 0.0, static_cast<double>(height_));
  const double bottom = std::clamp(to.y, 0.0, static_cast<double>(height_));
  if (top >= bottom) return;
  const int first = static_cast<int>(top), last = std::min(height_ - 1, static_cast<int>(std::ceil(bottom)) - 1);
  first_row_ = std::min(first_row_, first);
  last_row_ = std::max(last_row_, last);
  for (int y = first; y <= last; ++y) {
    const double y_a = std::max(top, static_cast<double>(y)), y_b = std::min(bottom, y + 1.0);
    const double x_a = from.x + slope * (y_a - from.y), x_b = from.x + slope * (y_b - from.y);
    // Screen y points down, so a positive outline runs clockwise and its right-hand edges run down: they subtract.
    add_span(&area_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_ + 2)], x_a, x_b, -sign * (y_b - y_a));
  }
}

// Spreads `area`, the height of an edge piece within one row, over the pixels that it crosses.
void Coverage::add_span(float* row, double x_a, double x_b, double area) const {
  const double right = width_;
  double low = std::clamp(std::min(x_a, x_b), 0.0, right), high = std::clamp(std::max(x_a, x_b), 0.0, right);
  const int first = static_cast<int>(low), last = static_cast<int>(std::ceil(high)) - 1;
  if (last <= first) {
    const double inside = 1 - ((low + high) / 2 - first);
    row[first] += static_cast<float>(area * inside);
    row[first + 1] += static_cast<float>(area * (1 - inside));
    return;
  }
  const double per_pixel = area / (high - low);
  for (int x = first; x <= last; ++x) {
    const double a = std::max(low, static_cast<double>(x)), b = std::min(high, x + 1.0);
    const double inside = 1 - ((a + b) / 2 - x), part = per_pixel * (b - a);
    row[x] += static_cast<float>(part * inside);
    row[x + 1] += static_cast<float>(part * (1 - inside));
  }
}

void Coverage::paint(const Paint& paint, Image& image) {
  for (int y = first_row_; y <= last_row_; ++y) {
    float* row = &area_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_ + 2)];
    double sum = 0;
    for (int x = 0; x < width_; ++x) {
      sum += static_cast<double>(row[x]);
      const double coverage = std::min(1.0, sum);
      if (coverage > 1e-4) blend(image.at(x, y), colour_at(paint, x + 0.5, y + 0.5), coverage);
    }
    std::fill(row, row + width_ + 2, 0.F);
  }
  first_row_ = height_;
  last_row_ = -1;
}

namespace {

constexpr double kPi = 3.14159265358979323846;

void append_arc(std::vector<Point>& out, Point centre, double radius, double from, double sweep) {
  const int steps = std::max(3, static_cast<int>(std::ceil(std::abs(sweep) * std::sqrt(std::max(radius, 0.5)) * 2)));
  for (int i = 0; i <= steps; ++i) {
    const double angle = from + sweep * i / steps;
    out.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
}

std::vector<Point> without_repeats(std::span<const Point> points) {
  std::vector<Point> out;
  for (const Point& p : points)
    if (out.empty() || std::hypot(p.x - out.back().x, p.y - out.back().y) > 1e-6) out.push_back(p);
  return out;
}

double direction(Point a, Point b) { return std::atan2(b.y - a.y, b.x - a.x); }

/// Outline of a line whose turns are gentle: both sides with mitred joins, closed by half circles.
std::vector<Point> smooth_stroke(std::span<const Point> points, double radius) {
  std::vector<Point> left, right;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double in = i > 0 ? direction(points[i - 1], points[i]) : direction(points[i], points[i + 1]);
    const double out = i + 1 < points.size() ? direction(points[i], points[i + 1]) : in;
    const double half_turn = std::remainder(out - in, 2 * kPi) / 2, normal = in + half_turn + kPi / 2;
    const double reach = radius / std::cos(half_turn);
    left.push_back({points[i].x + reach * std::cos(normal), points[i].y + reach * std::sin(normal)});
    right.push_back({points[i].x - reach * std::cos(normal), points[i].y - reach * std::sin(normal)});
  }
  std::vector<Point> outline = left;
  append_arc(outline, points.back(), radius, direction(points[points.size() - 2], points.back()) + kPi / 2, -kPi);
  outline.insert(outline.end(), right.rbegin(), right.rend());
  append_arc(outline, points.front(), radius, direction(points[0], points[1]) - kPi / 2, -kPi);
  return outline;
}

}  // namespace

std::vector<std::vector<Point>> stroke_outlines(std::span<const Point> points, double width) {
  const std::vector<Point> line = without_repeats(points);
  const double radius = width / 2;
  std::vector<std::vector<Point>> outlines;
  if (line.size() == 1) {
    append_arc(outlines.emplace_back(), line[0], radius, 0, 2 * kPi);
    return outlines;
  }
  constexpr double kSharpestMitre = 1.0;  // radians
  std::size_t first = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const bool last = i + 1 == line.size();
    if (!last && std::abs(std::remainder(direction(line[i], line[i + 1]) - direction(line[i - 1], line[i]), 2 * kPi)) <
                     kSharpestMitre)
      continue;
    outlines.push_back(smooth_stroke(std::span(line).subspan(first, i - first + 1), radius));
    first = i;
  }
  return outlines;
}

std::vector<std::vector<Point>> dashes(std::span<const Point> points, double length) {
  std::vector<std::vector<Point>> out;
  double left = length;
  bool on = true;
  if (!points.empty()) out.push_back({points[0]});
  for (std::size_t i = 1; i < points.size(); ++i) {
    Point a = points[i - 1];
    const Point b = points[i];
    for (double rest = std::hypot(b.x - a.x, b.y - a.y); rest > 0;) {
      const double step = std::min(rest, left);
      a = {a.x + (b.x - a.x) * step / rest, a.y + (b.y - a.y) * step / rest};
      rest -= step;
      left -= step;
      if (on) out.back().push_back(a);
      if (left > 0) continue;
      on = !on;
      left = length;
      if (on) out.push_back({a});
    }
  }
  return out;
}

}  // namespace motex
