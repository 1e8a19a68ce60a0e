// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/moveton_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/image/contour.h"

namespace motex {
namespace {

constexpr double kSamplesAScale = 3;
constexpr int kMostSamples = 160;  // a side
constexpr int kCorners = 28;
constexpr double kLongestTail = 5;  // radii

struct Box {
  double left = HUGE_VAL, top = HUGE_VAL, right = -HUGE_VAL, bottom = -HUGE_VAL;
};

Box box_of(std::span<const Base> bases) {
  Box box;
  for (const Base& base : bases) {
    const BaseReach reach = reach_of(base);
    box.left = std::min(box.left, base.x - reach.x);
    box.right = std::max(box.right, base.x + reach.x);
    box.top = std::min(box.top, base.y - reach.y);
    box.bottom = std::max(box.bottom, base.y + reach.y);
  }
  return box;
}

/// Largest |ψ|.
double crest_of(BaseKind kind) {
  if (kind == BaseKind::kLog) return 2;
  if (kind == BaseKind::kGaborCos) return 1 - std::exp(-kGaborFrequency * kGaborFrequency / 2);
  return kind == BaseKind::kGaborSin ? 0.59501 : 1;
}

/// Σ ±√|a| ψ with `step` pixels from sample to sample, first sample at the corner of the box.
Plane sampled(std::span<const Base> bases, const Box& box, double step) {
  const int width = static_cast<int>((box.right - box.left) / step) + 1,
            height = static_cast<int>((box.bottom - box.top) / step) + 1;
  Plane sum(width, height);
  std::vector<float> values(sum.values.size());
  for (Base base : bases) {
    const double peak = peak_amplitude(base) / crest_of(base.kind);
    const auto weight = static_cast<float>(std::copysign(std::sqrt(std::abs(peak)), peak));
    base.x = (base.x - box.left) / step;
    base.y = (base.y - box.top) / step;
    base.scale /= step;
    evaluate(base, 0, 0, width, height, values.data());
    for (std::size_t i = 0; i < values.size(); ++i) sum.values[i] += weight * values[i];
  }
  return sum;
}

std::vector<Point> scaled_about(std::vector<Point> points, Point centre, double size) {
  for (Point& p : points) p = {centre.x + size * (p.x - centre.x), centre.y + size * (p.y - centre.y)};
  return points;
}

}  // namespace

std::vector<std::vector<Point>> shape_of_bases(std::span<const Base> bases, double share) {
  if (bases.empty()) return {};
  const Box box = box_of(bases);
  double finest = HUGE_VAL;
  for (const Base& base : bases) finest = std::min(finest, base.scale);
  const double longest = std::max(box.right - box.left, box.bottom - box.top);
  const double step = std::max(finest / kSamplesAScale, longest / kMostSamples);
  Plane sum = sampled(bases, box, step);
  const auto [low, high] = std::minmax_element(sum.values.begin(), sum.values.end());
  const float sign = -*low > *high ? -1.F : 1.F, peak = std::max(-*low, *high);
  if (!(peak > 0)) return {};
  for (float& value : sum.values) value *= sign;
  std::vector<std::vector<Point>> outlines;
  for (const Contour& contour : contours(sum, static_cast<float>(share) * peak)) {
    std::vector<Point>& outline = outlines.emplace_back();
    for (const ContourPoint& p : contour) outline.push_back({box.left + 0.5 + p.x * step, box.top + 0.5 + p.y * step});
  }
  return outlines;
}

std::vector<Point> drop_outline(Point centre, double radius, double vx, double vy) {
  const double speed = std::hypot(vx, vy);
  const bool is_drop = speed > 3 * radius;
  std::vector<Point> outline;
  if (!is_drop) {
    for (int k = 0; k < kCorners; ++k) {
      const double angle = 2 * std::numbers::pi * k / kCorners;
      outline.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
    }
    return outline;
  }
  // Half a circle in front, and behind it a tail that narrows to a point.
  const double along_x = vx / speed, along_y = vy / speed, tail = std::min(speed, kLongestTail * radius);
  const double front = 0.25 * tail;  // what the exposure saw lies around the centre
  const auto at = [&](double along, double across) {
    outline.push_back({centre.x + (front + along) * along_x - across * along_y,
                       centre.y + (front + along) * along_y + across * along_x});
  };
  for (int k = 0; k <= kCorners / 2; ++k) {
    const double angle = std::numbers::pi * (2.0 * k / kCorners - 0.5);
    at(radius * std::cos(angle), radius * std::sin(angle));
  }
  constexpr int kTailPoints = 8;
  for (const int side : {1, -1})
    for (int k = 1; k < kTailPoints; ++k) {
      const double share = static_cast<double>(side > 0 ? k : kTailPoints - k) / kTailPoints;
      at(-share * tail, side * radius * (1 - share) * (1 - 0.3 * share));
      if (side > 0 && k == kTailPoints - 1) at(-tail, 0);
    }
  return outline;
}

std::vector<Point> leaf_outline(Point centre, double angle, double along, double across) {
  const double c = std::cos(angle), s = std::sin(angle);
  std::vector<Point> outline;
  for (int k = 0; k < kCorners; ++k) {
    const double turn = 2 * std::numbers::pi * k / kCorners;
    const double u = across * std::cos(turn) * std::abs(std::cos(turn)), v = along * std::sin(turn);
    outline.push_back({centre.x + u * c - v * s, centre.y + u * s + v * c});
  }
  return outline;
}

std::vector<std::vector<Point>> cartoon_outlines(std::span<const Base> bases, double vx, double vy, double size) {
  if (bases.empty()) return {};
  const Base& core = bases[0];
  const Point centre{core.x + 0.5, core.y + 0.5};
  if (bases.size() > 1) {
    std::vector<std::vector<Point>> outlines = shape_of_bases(bases);
    for (std::vector<Point>& outline : outlines) outline = scaled_about(std::move(outline), centre, size);
    return outlines;
  }
  const double scale = core.scale * size;
  if (is_oriented(core.kind)) return {leaf_outline(centre, core.angle, 2.6 * scale, 1.1 * scale)};
  return {drop_outline(centre, 1.5 * scale, vx, vy)};
}

}  // namespace motex
