// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/blob_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace motex {
namespace {

constexpr double kReach = 3.3;  // deviations; e^{−3.3²/2} = 0.004

}  // namespace

double Blob::scale() const { return std::exp(log_scale); }
double Blob::energy_root() const { return std::abs(amplitude) * scale() * std::sqrt(std::numbers::pi); }
double Blob::aspect() const { return std::exp(std::hypot(e1, e2)); }
double Blob::angle() const {
  const double angle = 0.5 * std::atan2(e2, e1);
  return angle < 0 ? angle + std::numbers::pi : angle;
}

BlobPrecision precision_of(double log_scale, double e1, double e2) {
  const double inverse = std::exp(-2 * log_scale), e = std::hypot(e1, e2);
  if (e < 1e-9) return {inverse * (1 - e1), -inverse * e2, inverse * (1 + e1)};
  const double even = std::cosh(e), odd = std::sinh(e) / e;
  return {inverse * (even - odd * e1), -inverse * odd * e2, inverse * (even + odd * e1)};
}

PixelBox intersection(const PixelBox& a, const PixelBox& b) {
  return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right), std::min(a.bottom, b.bottom)};
}

PixelBox box_of(const Blob& blob, const Plane& image, double margin) {
  const BlobPrecision p = precision_of(blob.log_scale, blob.e1, blob.e2);
  const double area = p.xx * p.yy - p.xy * p.xy;
  const double reach_x = kReach * std::sqrt(p.yy / area) + margin, reach_y = kReach * std::sqrt(p.xx / area) + margin;
  const auto pixel = [](double value, int size) {
    return static_cast<int>(std::clamp(value, -1.0, static_cast<double>(size) + 1));
  };
  return {std::max(0, pixel(std::ceil(blob.x - reach_x), image.width)),
          std::max(0, pixel(std::ceil(blob.y - reach_y), image.height)),
          std::min(image.width, pixel(std::floor(blob.x + reach_x), image.width) + 1),
          std::min(image.height, pixel(std::floor(blob.y + reach_y), image.height) + 1)};
}

void fill_gaussian(const Blob& blob, const PixelBox& box, float* out) {
  const BlobPrecision p = precision_of(blob.log_scale, blob.e1, blob.e2);
  std::array<float, 256> columns;
  const bool is_separable = blob.e1 == 0 && blob.e2 == 0 && box.width() <= static_cast<int>(columns.size());
  if (is_separable)
    for (int x = 0; x < box.width(); ++x) {
      const double dx = box.left + x - blob.x;
      columns[static_cast<std::size_t>(x)] = static_cast<float>(std::exp(-0.5 * p.xx * dx * dx));
    }
  const double ratio_step = std::exp(-p.xx);
  for (int y = box.top; y < box.bottom; ++y) {
    const double dy = y - blob.y;
    if (is_separable) {
      const auto row = static_cast<float>(std::exp(-0.5 * p.yy * dy * dy));
      for (int x = 0; x < box.width(); ++x) *out++ = row * columns[static_cast<std::size_t>(x)];
      continue;
    }
    // Along a row the exponent is a square polynomial: it goes on by multiplication.
    const double dx = box.left - blob.x;
    double value = std::exp(-0.5 * (p.xx * dx * dx + 2 * p.xy * dx * dy + p.yy * dy * dy));
    double ratio = std::exp(-p.xx * (dx + 0.5) - p.xy * dy);
    for (int x = 0; x < box.width(); ++x) {
      *out++ = static_cast<float>(value);
      value *= ratio;
      ratio *= ratio_step;
    }
  }
}

}  // namespace motex
