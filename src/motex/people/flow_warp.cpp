// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/flow_warp.h"

#include <cmath>

#include "motex/image/flow.h"
#include "motex/people/field_morph.h"

namespace motex {
namespace {

constexpr int kMargin = 8;           // pixels round the sprites: things may move there
constexpr double kThereAndBack = 2;  // pixels
constexpr int kSpacing = 4;
constexpr float kGrey = 128;

/// Luma over middle grey, and half of alpha, of what is in the box.
Planes planes_of(const PlacedSprite& placed_sprite, const BoundingBox& box) {
  const Sprite sprite = placed(placed_sprite.sprite, placed_sprite.placement);
  Planes planes{Plane(box.width(), box.height(), kGrey), Plane(box.width(), box.height())};
  for (int y = 0; y < sprite.height; ++y) {
    for (int x = 0; x < sprite.width; ++x) {
      const auto& [r, g, b, alpha] = sprite.at(x, y);
      const int px = sprite.left + x - box.left, py = sprite.top + y - box.top;
      planes[0].at(px, py) = luma_of<float>(r, g, b) + (255 - static_cast<float>(alpha)) * (kGrey / 255);
      planes[1].at(px, py) = static_cast<float>(alpha) / 2;
    }
  }
  return planes;
}

WarpGrid start_of(const std::vector<FeatureLinePair>& lines, const BoundingBox& box, bool from_a) {
  std::vector<FeatureLine> in_a, in_b;
  for (const FeatureLinePair& pair : lines) in_a.push_back(pair.a), in_b.push_back(pair.b);
  WarpGrid grid = from_a ? field_warp(in_a, in_b, box) : field_warp(in_b, in_a, box);
  grid.left = grid.top = 0;
  return grid;
}

/// Share of the pixels seen in the first plane's picture from which there and back ends where it began.
double consistent_share(const WarpGrid& there, const WarpGrid& back, const Plane& alpha) {
  double good = 0, all = 0;
  for (int y = 0; y < alpha.height; y += 3) {
    for (int x = 0; x < alpha.width; x += 3) {
      if (alpha.at(x, y) < 64) continue;
      const auto u = there.at(x, y), v = back.at(x + u.x, y + u.y);
      ++all;
      good += std::hypot(u.x + v.x, u.y + v.y) <= kThereAndBack ? 1 : 0;
    }
  }
  return all > 0 ? good / all : 0;
}

/// Along the columns or the rows of a grid: a mean of each point and its neighbours, ¼ ½ ¼, twice.
void smooth(std::vector<float>& values, int columns, int rows) {
  std::vector<float> before;
  const auto pass = [&](std::size_t count, std::size_t step, std::size_t lines, std::size_t line_step) {
    before = values;
    for (std::size_t line = 0; line < lines; ++line)
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = line * line_step + k * step;
        values[i] = (before[k > 0 ? i - step : i] + before[k + 1 < count ? i + step : i]) / 4 + before[i] / 2;
      }
  };
  const auto width = static_cast<std::size_t>(columns), height = static_cast<std::size_t>(rows);
  for (int repeat = 0; repeat < 2; ++repeat) pass(width, 1, height, width), pass(height, width, width, 1);
}

/// The flow where there and back ends where it began, the field of the lines where it does not: where limbs cover one
/// another flow finds no counterpart and tears. Both are joined smoothly: field + mean of trust · (flow − field).
WarpGrid trusted(const WarpGrid& there, const WarpGrid& back, const WarpGrid& field) {
  WarpGrid joined = there;
  for (int row = 0; row < there.rows; ++row) {
    for (int column = 0; column < there.columns; ++column) {
      const double x = column * there.spacing, y = row * there.spacing;
      const std::size_t i = there.index(column, row);
      const auto v = back.at(x + there.x[i], y + there.y[i]), f = field.at(x, y);
      const double lost = std::hypot(there.x[i] + v.x, there.y[i] + v.y) / kThereAndBack;
      const double trust = 1 / (1 + lost * lost * lost * lost);
      joined.x[i] = static_cast<float>(trust * (there.x[i] - f.x));
      joined.y[i] = static_cast<float>(trust * (there.y[i] - f.y));
    }
  }
  smooth(joined.x, joined.columns, joined.rows), smooth(joined.y, joined.columns, joined.rows);
  for (int row = 0; row < there.rows; ++row) {
    for (int column = 0; column < there.columns; ++column) {
      const auto f = field.at(column * there.spacing, row * there.spacing);
      const std::size_t i = there.index(column, row);
      joined.x[i] += static_cast<float>(f.x), joined.y[i] += static_cast<float>(f.y);
    }
  }
  return joined;
}

/// For each grid point y of the film: x − y with x + share · flow(x) = y.
WarpGrid warp_along(const WarpGrid& flow, double share) {
  WarpGrid warp = flow;
  for (int row = 0; row < flow.rows; ++row) {
    for (int column = 0; column < flow.columns; ++column) {
      const double px = flow.left + column * flow.spacing, py = flow.top + row * flow.spacing;
      const std::size_t i = flow.index(column, row);
      WarpGrid::Displacement u{flow.x[i], flow.y[i]};
      for (int iteration = 0; iteration < 4; ++iteration) u = flow.at(px - share * u.x, py - share * u.y);
      warp.x[i] = static_cast<float>(-share * u.x), warp.y[i] = static_cast<float>(-share * u.y);
    }
  }
  return warp;
}

}  // namespace

SpriteFlow sprite_flow(const PlacedSprite& a, const PlacedSprite& b, const std::vector<FeatureLinePair>& lines) {
  SpriteFlow flow;
  flow.box = joined(box_of(a.sprite, a.placement), box_of(b.sprite, b.placement));
  if (flow.box.empty()) return flow;
  const auto margin = [](bool cut_off_a, bool cut_off_b) { return cut_off_a || cut_off_b ? 0 : kMargin; };
  flow.box.left -= margin(a.cut_off.left, b.cut_off.left), flow.box.top -= margin(a.cut_off.top, b.cut_off.top);
  flow.box.right += margin(a.cut_off.right, b.cut_off.right);
  flow.box.bottom += margin(a.cut_off.bottom, b.cut_off.bottom);
  const Planes in_a = planes_of(a, flow.box), in_b = planes_of(b, flow.box);
  FlowOptions options;
  options.spacing = kSpacing;
  const WarpGrid start_a = start_of(lines, flow.box, true), start_b = start_of(lines, flow.box, false);
  flow.a_to_b = optical_flow(in_a, in_b, options, &start_a);
  flow.b_to_a = optical_flow(in_b, in_a, options, &start_b);
  flow.consistency =
      (consistent_share(flow.a_to_b, flow.b_to_a, in_a[1]) + consistent_share(flow.b_to_a, flow.a_to_b, in_b[1])) / 2;
  if (!lines.empty()) {
    const WarpGrid there = trusted(flow.a_to_b, flow.b_to_a, start_a);
    flow.b_to_a = trusted(flow.b_to_a, flow.a_to_b, start_b);
    flow.a_to_b = there;
  }
  for (WarpGrid* grid : {&flow.a_to_b, &flow.b_to_a}) grid->left = flow.box.left, grid->top = flow.box.top;
  return flow;
}

Sprite flow_morph(const PlacedSprite& a, const PlacedSprite& b, const SpriteFlow& flow, double weight, double dissolve,
                  int jobs) {
  if (flow.box.empty()) return {};
  const auto to_a = [&] { return warp_along(flow.a_to_b, weight); };
  const auto to_b = [&] { return warp_along(flow.b_to_a, 1 - weight); };
  if (dissolve == 0) return warped({a, to_a()}, flow.box, jobs);
  if (dissolve == 1) return warped({b, to_b()}, flow.box, jobs);
  return dissolved({a, to_a()}, {b, to_b()}, dissolve, flow.box, jobs);
}

}  // namespace motex
