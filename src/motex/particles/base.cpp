// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/base.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr double kReach = 3.2;     // envelope e^{−3.2²/2} = 0.006
constexpr double kLogReach = 3.9;  // its ring has more weight
constexpr double kDeepest = 200;   // e^{−200} can still be multiplied up again

/// ψ over a box whose top left pixel is (left, top).
void fill_round(const Base& base, int left, int top, int width, int height, float* out) {
  const double inverse = 1 / (2 * base.scale * base.scale);
  std::vector<double> envelope(static_cast<std::size_t>(width));
  for (int x = 0; x < width; ++x)
    envelope[static_cast<std::size_t>(x)] = std::exp(-(left + x - base.x) * (left + x - base.x) * inverse);
  for (int y = 0; y < height; ++y) {
    const double dy = top + y - base.y, row = std::exp(-dy * dy * inverse);
    for (int x = 0; x < width; ++x) {
      const double dx = left + x - base.x, gaussian = row * envelope[static_cast<std::size_t>(x)];
      *out++ = static_cast<float>(
          base.kind == BaseKind::kGaussian ? gaussian : (2 - 2 * (dx * dx + dy * dy) * inverse) * gaussian);
    }
  }
}

/// Along a row the exponent is a square polynomial and the phase linear, so both go on by multiplication. A streak is a
/// Gcos of frequency and mean zero.
void fill_oriented(const Base& base, int left, int top, int width, int height, float* out) {
  const double c = std::cos(base.angle), s = std::sin(base.angle), inverse = 1 / (2 * base.scale * base.scale);
  const bool is_streak = base.kind == BaseKind::kStreak;
  const double frequency = is_streak ? 0 : kGaborFrequency / base.scale;
  const double mean = is_streak ? 0 : std::exp(-kGaborFrequency * kGaborFrequency / 2);
  const double flatness = 1 / (kGaborElongation * kGaborElongation);
  const double square = (c * c + s * s * flatness) * inverse, ratio_step = std::exp(-2 * square);
  const double turn_cos = std::cos(frequency * c), turn_sin = std::sin(frequency * c);
  const double weight_cos = base.kind == BaseKind::kGaborSin ? 0 : 1, weight_sin = 1 - weight_cos;
  for (int y = 0; y < height; ++y) {
    const double dx = left - base.x, dy = top + y - base.y;
    const double u = dx * c + dy * s, v = dy * c - dx * s;
    const double exponent = (u * u + v * v * flatness) * inverse;
    double envelope = std::exp(-exponent);
    double ratio = std::exp(-(square + 2 * (u * c - v * s * flatness) * inverse));
    double wave_cos = std::cos(frequency * u), wave_sin = std::sin(frequency * u);
    for (int x = 0; x < width; ++x) {
      if (exponent > kDeepest) {  // nothing to multiply on from
        const double across = u + x * c, along = v - x * s;
        envelope = std::exp(-(across * across + along * along * flatness) * inverse);
      }
      *out++ = static_cast<float>(envelope * (weight_cos * (wave_cos - mean) + weight_sin * wave_sin));
      envelope *= ratio;
      ratio *= ratio_step;
      const double next_cos = wave_cos * turn_cos - wave_sin * turn_sin;
      wave_sin = wave_sin * turn_cos + wave_cos * turn_sin;
      wave_cos = next_cos;
    }
  }
}

}  // namespace

bool is_oriented(BaseKind kind) {
  return kind == BaseKind::kGaborCos || kind == BaseKind::kGaborSin || kind == BaseKind::kStreak;
}

BaseReach reach_of(const Base& base) {
  if (!is_oriented(base.kind)) {
    const int reach = static_cast<int>(std::ceil((base.kind == BaseKind::kLog ? kLogReach : kReach) * base.scale));
    return {reach, reach};
  }
  const double across = kReach * base.scale, along = kGaborElongation * across;
  const double c = std::cos(base.angle), s = std::sin(base.angle);
  return {static_cast<int>(std::ceil(std::hypot(across * c, along * s))),
          static_cast<int>(std::ceil(std::hypot(across * s, along * c)))};
}

void evaluate(const Base& base, int left, int top, int width, int height, float* out) {
  (is_oriented(base.kind) ? fill_oriented : fill_round)(base, left, top, width, height, out);
}

BasePatch render_patch(const Base& base, int width, int height) {
  const BaseReach reach = reach_of(base);
  const int left = static_cast<int>(std::floor(base.x)) - reach.x, top = static_cast<int>(std::floor(base.y)) - reach.y;
  const int full_width = 2 * reach.x + 2, full_height = 2 * reach.y + 2;
  std::vector<float> full(static_cast<std::size_t>(full_width) * static_cast<std::size_t>(full_height));
  evaluate(base, left, top, full_width, full_height, full.data());
  double energy = 0;
  for (const float value : full) energy += static_cast<double>(value) * value;
  const auto norm = static_cast<float>(energy > 0 ? 1 / std::sqrt(energy) : 0);

  BasePatch patch;
  patch.left = std::max(left, 0);
  patch.top = std::max(top, 0);
  patch.width = std::max(0, std::min(left + full_width, width) - patch.left);
  patch.height = std::max(0, std::min(top + full_height, height) - patch.top);
  patch.values.resize(static_cast<std::size_t>(patch.width) * static_cast<std::size_t>(patch.height));
  for (int y = 0; y < patch.height; ++y) {
    const float* source = full.data() +
                          static_cast<std::size_t>(patch.top + y - top) * static_cast<std::size_t>(full_width) +
                          (patch.left - left);
    for (int x = 0; x < patch.width; ++x) patch.row(y)[x] = norm * source[x];
  }
  return patch;
}

float inner_product(const BasePatch& patch, const Plane& image) {
  float sum = 0;
  for (int y = 0; y < patch.height; ++y) {
    const float *a = patch.row(y), *b = image.row(patch.top + y) + patch.left;
    float row = 0;
    for (int x = 0; x < patch.width; ++x) row += a[x] * b[x];
    sum += row;
  }
  return sum;
}

double inner_product(const BasePatch& a, const BasePatch& b) {
  const int left = std::max(a.left, b.left), right = std::min(a.left + a.width, b.left + b.width);
  const int top = std::max(a.top, b.top), bottom = std::min(a.top + a.height, b.top + b.height);
  double sum = 0;
  for (int y = top; y < bottom; ++y) {
    const float *row_a = a.row(y - a.top) + (left - a.left), *row_b = b.row(y - b.top) + (left - b.left);
    float row = 0;
    for (int x = 0; x < right - left; ++x) row += row_a[x] * row_b[x];
    sum += static_cast<double>(row);
  }
  return sum;
}

double energy_of(const BasePatch& patch) {
  double energy = 0;
  for (const float value : patch.values) energy += static_cast<double>(value) * static_cast<double>(value);
  return energy;
}

void add_patch(Plane& image, const BasePatch& patch, float weight) {
  for (int y = 0; y < patch.height; ++y) {
    const float* source = patch.row(y);
    float* target = image.row(patch.top + y) + patch.left;
    for (int x = 0; x < patch.width; ++x) target[x] += weight * source[x];
  }
}

Planes reconstruct(const BaseMap& map, Planes background, int num_bases) {
  if (static_cast<int>(background.size()) != map.num_planes)
    throw InvalidInput("the background must have as many planes as the base map");
  const std::size_t num =
      num_bases < 0 ? map.bases.size() : std::min(map.bases.size(), static_cast<std::size_t>(num_bases));
  for (std::size_t j = 0; j < num; ++j) {
    const BasePatch patch = render_patch(map.bases[j], map.width, map.height);
    for (std::size_t k = 0; k < background.size(); ++k) add_patch(background[k], patch, map.bases[j].coefficients[k]);
  }
  return background;
}

const char* name_of(BaseKind kind) {
  constexpr const char* kNames[] = {"log", "gcos", "gsin", "gaussian", "streak"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace motex
