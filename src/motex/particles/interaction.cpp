// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/interaction.h"

#include <algorithm>
#include <cmath>

namespace motex {
namespace {

constexpr double kFitted = 0.7;
constexpr double kFar = 3;  // r

struct Moving {
  double x, y, ux, uy;  ///< in frame t: place, velocity from t − 1 to t beyond the flow
  double next_x, next_y;
  bool has_next;
};

/// Sums of products of (own, neighbours, next), both components.
struct Moments {
  double oo = 0, on = 0, nn = 0, oy = 0, ny = 0, yy = 0;
  std::int64_t count = 0;
  void add(double own, double neighbours, double next) {
    oo += own * own;
    on += own * neighbours;
    nn += neighbours * neighbours;
    oy += own * next;
    ny += neighbours * next;
    yy += next * next;
    ++count;
  }
  double squares_left(double phi, double gamma) const {
    return yy - 2 * phi * oy - 2 * gamma * ny + phi * phi * oo + 2 * phi * gamma * on + gamma * gamma * nn;
  }
};

FlowField::Velocity mean_velocity(const std::vector<Cable>& cables) {
  FlowField::Velocity sum;
  double count = 1e-9;
  for (const Cable& cable : cables)
    for (std::size_t k = 1; k < cable.core.size(); ++k, count += 1) {
      sum.x += cable.core[k].x - cable.core[k - 1].x;
      sum.y += cable.core[k].y - cable.core[k - 1].y;
    }
  return {sum.x / count, sum.y / count};
}

std::vector<Moving> moving_in(const std::vector<Cable>& cables, std::int64_t frame, const FlowField& flow,
                              const FlowField::Velocity& mean) {
  std::vector<Moving> out;
  for (const Cable& cable : cables) {
    if (!cable.covers(frame) || !cable.covers(frame - 1)) continue;
    const Base &before = cable.at(frame - 1), &now = cable.at(frame);
    const auto beyond = [&](const Base& a, const Base& b, double& ux, double& uy) {
      const FlowField::Velocity v = flow.vx.values.empty() ? mean : flow.at(a.x, a.y);
      ux = b.x - a.x - v.x;
      uy = b.y - a.y - v.y;
    };
    Moving one{now.x, now.y, 0, 0, 0, 0, cable.covers(frame + 1)};
    beyond(before, now, one.ux, one.uy);
    if (one.has_next) beyond(now, cable.at(frame + 1), one.next_x, one.next_y);
    out.push_back(one);
  }
  return out;
}

void add_frame(const std::vector<Moving>& all, double radius, Moments& moments) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].has_next) continue;
    double weight = 0, nx = 0, ny = 0;
    for (std::size_t j = 0; j < all.size(); ++j) {
      const double dx = all[j].x - all[i].x, dy = all[j].y - all[i].y, d = (dx * dx + dy * dy) / (radius * radius);
      if (j == i || d > kFar * kFar) continue;
      const double w = std::exp(-d / 2);
      weight += w;
      nx += w * all[j].ux;
      ny += w * all[j].uy;
    }
    if (weight <= 0) continue;
    moments.add(all[i].ux, nx / weight, all[i].next_x);
    moments.add(all[i].uy, ny / weight, all[i].next_y);
  }
}

}  // namespace

Interaction measure_interaction(const std::vector<Cable>& cables, std::int64_t num_frames, const FlowField& flow,
                                double radius) {
  const FlowField::Velocity mean = mean_velocity(cables);
  Moments fitted, held_out;
  const auto border = static_cast<std::int64_t>(kFitted * static_cast<double>(num_frames));
  for (std::int64_t t = 1; t + 1 < num_frames; ++t)
    add_frame(moving_in(cables, t, flow, mean), radius, t + 1 < border ? fitted : held_out);
  Interaction out;
  out.num_steps = fitted.count / 2;
  const double determinant = fitted.oo * fitted.nn - fitted.on * fitted.on;
  if (fitted.count < 10 || !(determinant > 1e-12 * fitted.oo * fitted.nn)) return out;
  out.persistence = (fitted.oy * fitted.nn - fitted.ny * fitted.on) / determinant;
  out.coupling = (fitted.ny * fitted.oo - fitted.oy * fitted.on) / determinant;
  out.persistence_alone = fitted.oy / fitted.oo;
  const double variance = fitted.squares_left(out.persistence, out.coupling) / static_cast<double>(fitted.count - 2);
  out.coupling_error = std::sqrt(std::max(0.0, variance * fitted.oo / determinant));
  if (held_out.yy > 0) {
    out.explained_alone = 1 - held_out.squares_left(out.persistence_alone, 0) / held_out.yy;
    out.explained_with = 1 - held_out.squares_left(out.persistence, out.coupling) / held_out.yy;
  }
  return out;
}

}  // namespace motex
