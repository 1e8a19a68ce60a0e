// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/coil_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "motex/particles/refine.h"

namespace motex {
namespace {

constexpr std::array<double, 3> kRelativeScales{0.5, 0.8, 1.25};
constexpr int kDirections = 6;
constexpr int kFitSteps = 3;
constexpr double kSmallestScale = 0.7, kLargestRelativeScale = 2;
constexpr double kCrestOfGsin = 0.813;  // of sin(ωq) e^{−q²/2}

/// Blurs with a Gaussian of that deviation, then scales so that a value is ⟨image, b⟩ of a Gaussian of unit norm.
void gaussian_responses(const Plane& image, double scale, Plane& across, Plane& out) {
  const int reach = static_cast<int>(std::ceil(3 * scale));
  std::vector<float> taps(static_cast<std::size_t>(2 * reach + 1));
  float energy = 0;
  for (int k = -reach; k <= reach; ++k) {
    const auto tap = static_cast<float>(std::exp(-k * k / (2 * scale * scale)));
    taps[static_cast<std::size_t>(k + reach)] = tap;
    energy += tap * tap;
  }
  for (float& tap : taps) tap /= std::sqrt(energy);
  const int width = image.width, height = image.height;
  across = Plane(width, height);
  out = Plane(width, height);
  for (int y = 0; y < height; ++y)
    for (int k = -reach; k <= reach; ++k) {
      const int first = std::max(0, -k), last = std::min(width, width - k);
      const float tap = taps[static_cast<std::size_t>(k + reach)], *in = image.row(y);
      float* target = across.row(y);
      for (int x = first; x < last; ++x) target[x] += tap * in[x + k];
    }
  for (int y = 0; y < height; ++y)
    for (int k = std::max(-reach, -y); k <= std::min(reach, height - 1 - y); ++k) {
      const float tap = taps[static_cast<std::size_t>(k + reach)], *in = across.row(y + k);
      float* target = out.row(y);
      for (int x = 0; x < width; ++x) target[x] += tap * in[x];
    }
}

bool within(double x, double y, const Base& core, double reach) {
  const double dx = x - core.x, dy = y - core.y, near = reach * core.scale;
  return dx * dx + dy * dy <= near * near;
}

struct Place {
  int x = 0, y = 0;
  float response = 0;
};

/// Strongest response within reach of a core in window coordinates.
Place strongest_place(const Plane& responses, const Base& core, double reach) {
  Place best;
  for (int y = 0; y < responses.height; ++y)
    for (int x = 0; x < responses.width; ++x)
      if (std::abs(responses.at(x, y)) > std::abs(best.response) && within(x, y, core, reach))
        best = {x, y, responses.at(x, y)};
  return best;
}

/// Keeps the better one.
void try_base(const Plane& image, const Base& base, CoilFit& best) {
  const FittedBase fitted = refine_base(image, base, 0);
  if (std::abs(fitted.coefficient) > std::abs(best.coefficient)) best = {fitted.base, fitted.coefficient};
}

void try_directions(const Plane& image, const Place& place, double scale, CoilFit& best) {
  for (int k = 0; k < kDirections; ++k) {
    const double angle = std::numbers::pi * k / kDirections;
    try_base(image, {BaseKind::kGaborCos, static_cast<double>(place.x), static_cast<double>(place.y), scale, angle, {}},
             best);
    for (const double side : {-1.0, 1.0}) {
      const double away = side * kCrestOfGsin * scale;
      try_base(
          image,
          {BaseKind::kGaborSin, place.x + away * std::cos(angle), place.y + away * std::sin(angle), scale, angle, {}},
          best);
    }
  }
}

Base in_window(Base base, const CoilWindow& window) {
  base.x -= window.left;
  base.y -= window.top;
  return base;
}

CoilFit fitted(const CoilWindow& window, const Base& start, const Base& core, double reach) {
  FittedBase fit = refine_base(window.residual, start, kFitSteps);
  CoilFit out{fit.base, fit.coefficient};
  out.base.x += window.left;
  out.base.y += window.top;
  const bool fits = within(out.base.x, out.base.y, core, reach * 1.1) &&
                    out.base.scale <= kLargestRelativeScale * core.scale && std::isfinite(out.coefficient);
  if (!fits) out.coefficient = 0;
  return out;
}

/// Pixels that are nearer to the other core in its scales become zero. Along a row the difference of both squared
/// distances is a polynomial.
void give_to_nearer(CoilWindow& window, const Base& core, const Base& other) {
  const double weight = core.scale * core.scale / (other.scale * other.scale);
  const double mine_x = window.left - core.x, theirs_x = window.left - other.x;
  const auto square = static_cast<float>(weight - 1), slope = static_cast<float>(2 * (weight * theirs_x - mine_x));
  for (int y = 0; y < window.residual.height; ++y) {
    const double mine_y = window.top + y - core.y, theirs_y = window.top + y - other.y;
    const auto level =
        static_cast<float>(weight * (theirs_x * theirs_x + theirs_y * theirs_y) - mine_x * mine_x - mine_y * mine_y);
    float* row = window.residual.row(y);
    for (int x = 0; x < window.residual.width; ++x) {
      const auto at = static_cast<float>(x);
      row[x] = (square * at + slope) * at + level < 0 ? 0 : row[x];
    }
  }
}

}  // namespace

CoilWindow cut_window(const Plane& residual, const Base& core, const std::vector<Base>& others, double reach) {
  const double half = (reach + 2) * core.scale + 1;
  CoilWindow out;
  out.left = std::max(0, static_cast<int>(std::floor(core.x - half)));
  out.top = std::max(0, static_cast<int>(std::floor(core.y - half)));
  const int right = std::min(residual.width, static_cast<int>(std::ceil(core.x + half)) + 1),
            bottom = std::min(residual.height, static_cast<int>(std::ceil(core.y + half)) + 1);
  if (right <= out.left || bottom <= out.top) return out;
  out.residual = Plane(right - out.left, bottom - out.top);
  for (int y = 0; y < out.residual.height; ++y)
    std::copy_n(residual.row(out.top + y) + out.left, out.residual.width, out.residual.row(y));
  for (const Base& other : others) {
    // farther than that from the window's corner it owns nothing there
    const double limit = 1.5 * half * (1 + other.scale / core.scale);
    if (std::hypot(core.x - other.x, core.y - other.y) < limit) give_to_nearer(out, core, other);
  }
  return out;
}

CoilFit find_coil(const CoilWindow& window, const Base& core, double reach, double min_coefficient) {
  CoilFit best;
  if (window.residual.values.empty()) return best;
  const Base centre = in_window(core, window);
  Plane across, responses;
  Place top;
  double top_scale = 0;
  for (const double relative : kRelativeScales) {
    const double scale = std::max(kSmallestScale, relative * core.scale);
    gaussian_responses(window.residual, scale, across, responses);
    const Place place = strongest_place(responses, centre, reach);
    if (std::abs(place.response) <= std::abs(top.response)) continue;
    top = place;
    top_scale = scale;
  }
  if (std::abs(top.response) < 0.7 * min_coefficient) return best;
  try_base(window.residual,
           {BaseKind::kGaussian, static_cast<double>(top.x), static_cast<double>(top.y), top_scale, 0, {}}, best);
  try_directions(window.residual, top, top_scale, best);
  return fitted(window, best.base, core, reach);
}

Base moved_with_core(const Base& base, const Base& from_core, const Base& to_core) {
  const double turn = is_oriented(from_core.kind) && is_oriented(to_core.kind) ? to_core.angle - from_core.angle : 0;
  const double growth = to_core.scale / from_core.scale;
  const double dx = (base.x - from_core.x) * growth, dy = (base.y - from_core.y) * growth;
  Base out = base;
  out.x = to_core.x + dx * std::cos(turn) - dy * std::sin(turn);
  out.y = to_core.y + dx * std::sin(turn) + dy * std::cos(turn);
  out.scale = base.scale * growth;
  if (is_oriented(base.kind)) out.angle += turn;
  return out;
}

CoilFit carry_coil(const CoilWindow& window, const Base& core, const CoilFit& from, const Base& from_core,
                   double reach) {
  Base start = moved_with_core(from.base, from_core, core);
  start.scale = std::max(start.scale, kSmallestScale);
  const Base local = in_window(start, window);
  const bool inside =
      local.x >= 0 && local.y >= 0 && local.x <= window.residual.width - 1 && local.y <= window.residual.height - 1;
  if (!inside) return {start, 0};
  CoilFit out = fitted(window, local, core, reach);
  if (out.coefficient == 0) out.base = start;
  return out;
}

}  // namespace motex
