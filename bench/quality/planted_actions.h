// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

// Series with actions planted between idle frames (sway and noise), whose truth is known.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "motex/core/matrix.h"
#include "motex/core/rng.h"

namespace motex::bench {

inline constexpr double kPi = std::numbers::pi;

struct Variant {
  const char* name;
  int classes, performances, window;  ///< window: frames of an action
  double warp, noise;                 ///< warp: ± share of the tempo; noise: deviation
};

struct Planted {
  FrameMatrix series;
  std::vector<std::pair<int, int>> truth;  // start, class
};

inline double action(int kind, double t) {
  const double bell = std::sin(kPi * t);
  switch (kind) {
    case 0:
      return 0.25 * bell * bell * std::sin(4 * kPi * t);
    case 1:
      return 0.35 * std::exp(-std::pow((t - 0.3) / 0.09, 2)) + 0.2 * std::exp(-std::pow((t - 0.7) / 0.12, 2));
    case 2:
      return 0.3 * std::max(0.0, 1 - std::abs(t - 0.5) * 4);
    case 3:
      return 0.28 * bell * std::sin(2 * kPi * (1 + 2 * t) * t);
    case 4:
      return -0.3 * bell * bell;
    default:
      return 0.3 * bell * (t < 0.5 ? -1 : 1) * std::abs(std::cos(kPi * t));
  }
}

inline Planted plant(const Variant& variant, std::uint64_t seed) {
  Rng rng(seed);
  const int total = variant.classes * variant.performances, gap = 5 * variant.window + 40;
  const int num_frames = 60 + total * gap + 200;
  std::vector<double> sway(static_cast<std::size_t>(num_frames), 0);
  double a = 0, b = 0, squares = 0;
  for (double& x : sway) {
    a = 0.95 * a + rng.normal();
    b = 0.95 * b + a;
    x = b;
    squares += b * b;
  }
  const double scale = 0.02 / std::sqrt(squares / num_frames);
  Planted out{FrameMatrix(num_frames, 1), {}};
  for (int t = 0; t < num_frames; ++t)
    out.series(t, 0) = 0.45 + scale * sway[static_cast<std::size_t>(t)] + variant.noise * rng.normal();
  std::vector<int> order;
  for (int k = 0; k < total; ++k) order.push_back(k % variant.classes);
  for (std::size_t k = order.size(); k-- > 1;) std::swap(order[k], order[rng.below(k + 1)]);
  for (int k = 0; k < total; ++k) {
    const int kind = order[static_cast<std::size_t>(k)];
    const int length = static_cast<int>(std::lround(variant.window * rng.uniform(1 - variant.warp, 1 + variant.warp)));
    const int start = 60 + k * gap + static_cast<int>(rng.below(60));
    const double strength = 1 + 0.1 * rng.normal();
    for (int t = 0; t < length; ++t) out.series(start + t, 0) += strength * action(kind, t / (length - 1.0));
    out.truth.emplace_back(start, kind);
  }
  return out;
}

}  // namespace motex::bench
