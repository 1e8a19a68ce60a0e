// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "motex/image/planes.h"

namespace motex {

/// Base functions ψ_ℓ of [TM02] section 2 (blob, bar, edge), and beyond the paper a plain Gaussian and a long one. With
/// u = x cos θ + y sin θ, v = −x sin θ + y cos θ relative to the centre, and s = scale:
///   LoG   (2 − r²/s²) e^{−r²/2s²}
///   Gcos  (cos(ωu/s) − e^{−ω²/2}) e^{−(u² + v²/4)/2s²},  ω = 1.2
///   Gsin  sin(ωu/s) e^{−(u² + v²/4)/2s²}
///   Gaussian  e^{−r²/2s²}
///   streak    e^{−(u² + v²/4)/2s²}, for cores of elongated elements: a Gcos has lobes beside it of −45 %
/// each divided by its norm over the pixels.
/// Files know the kinds by their numbers.
enum class BaseKind { kLog, kGaborCos, kGaborSin, kGaussian, kStreak };
constexpr std::size_t kNumBaseKinds = 5;

bool is_oriented(BaseKind kind);  ///< Gcos, Gsin, streak

constexpr double kGaborFrequency = 1.2;  ///< ω
constexpr double kGaborElongation = 2;   ///< of the envelope of oriented kinds, along v
constexpr double kMinScale = 0.75;       ///< pixels
constexpr double kMaxScale = 8;
constexpr int kNumScales = 8;
constexpr int kNumOrientations = 12;

/// One element b_j of a base map: coefficient · ψ_ℓ moved to (x, y), turned by angle, scaled.
struct Base {
  BaseKind kind = BaseKind::kLog;
  double x = 0;      ///< pixels, pixel centres at integers
  double y = 0;      ///< downwards
  double scale = 1;  ///< σ_j, pixels
  double angle = 0;  ///< θ_j, radians from the x axis towards the y axis, in [0, π); 0 for round kinds
  /// α_j of each plane (1 = grey, 3 = colour), grey levels · pixels, since bases have unit norm.
  std::array<float, 3> coefficients{};
};

/// The base representation B of one image.
struct BaseMap {
  int width = 0;
  int height = 0;
  int num_planes = 1;
  std::vector<Base> bases;  ///< in the order in which they were found
};

/// A base on the pixels that it reaches inside an image.
struct BasePatch {
  int left = 0, top = 0, width = 0, height = 0;
  std::vector<float> values;  ///< width · height, row by row

  const float* row(int y) const {
    return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
  float* row(int y) { return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width); }
};

/// Half width and height of the box outside which the base is below 1/100 of its peak.
struct BaseReach {
  int x = 0, y = 0;
};
BaseReach reach_of(const Base& base);

/// ψ, not normalised, on the box whose top left pixel is (left, top), row by row into `out` (width · height).
void evaluate(const Base& base, int left, int top, int width, int height, float* out);

/// Unit norm over all pixels, then cut to an image of width × height (empty when it lies outside).
BasePatch render_patch(const Base& base, int width, int height);

/// ⟨patch, image⟩ over the patch.
float inner_product(const BasePatch& patch, const Plane& image);
/// ⟨a, b⟩ over the pixels that both reach; 0 when there are none.
double inner_product(const BasePatch& a, const BasePatch& b);
/// ‖patch‖² over its pixels.
double energy_of(const BasePatch& patch);
/// image += weight · patch.
void add_patch(Plane& image, const BasePatch& patch, float weight);

/// Σ α_j b_j of the first num_bases bases (−1 = all) onto `background`, of which there must be num_planes planes.
Planes reconstruct(const BaseMap& map, Planes background, int num_bases = -1);

const char* name_of(BaseKind kind);  ///< "log", "gcos", "gsin", "gaussian", "streak"

}  // namespace motex
