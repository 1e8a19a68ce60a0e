// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/measure_silhouette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace motex {
namespace {

/// Σ α x^p y^q with p + q ≤ 3 of alpha 0 … 255, about a point near the middle: exact up to rounding of doubles.
struct RawMoments {
  double m00 = 0, m10 = 0, m01 = 0, m20 = 0, m11 = 0, m02 = 0, m30 = 0, m21 = 0, m12 = 0, m03 = 0;

  /// Adds a row at height y with Σ α, Σ α x, Σ α x², Σ α x³.
  void add_row(double y, const std::array<double, 4>& row) {
    const auto [s0, s1, s2, s3] = row;
    m00 += s0, m10 += s1, m20 += s2, m30 += s3;
    m01 += s0 * y, m11 += s1 * y, m21 += s2 * y;
    m02 += s0 * y * y, m12 += s1 * y * y, m03 += s0 * y * y * y;
  }
};

constexpr int kBlock = SilhouetteParts::kBlock;  // 31³ and 255 fit 16 bits, so products are summed eight at a time

constexpr std::array<std::int16_t, kBlock> powers(int exponent) {
  std::array<std::int16_t, kBlock> out{};
  for (int j = 0; j < kBlock; ++j) {
    int power = 1;
    for (int k = 0; k < exponent; ++k) power *= j;
    out[static_cast<std::size_t>(j)] = static_cast<std::int16_t>(power);
  }
  return out;
}
constexpr std::array<std::int16_t, kBlock> kFirst = powers(1), kSecond = powers(2), kThird = powers(3);

/// Σ α j^p, p = 0 … 3, of one block, j = 0 … 31.
std::array<int, 4> block_sums(const std::uint8_t* alphas) {
  int s0 = 0, s1 = 0, s2 = 0, s3 = 0;
  for (std::size_t j = 0; j < kBlock; ++j) {
    const std::int16_t alpha = alphas[j];
    s0 += alpha;
    s1 += alpha * kFirst[j];
    s2 += alpha * kSecond[j];
    s3 += alpha * kThird[j];
  }
  return {s0, s1, s2, s3};
}

/// Whether all 32 are that.
bool all_are(const std::uint8_t* alphas, std::uint64_t eight) {
  std::array<std::uint64_t, kBlock / 8> words;
  std::memcpy(words.data(), alphas, kBlock);
  return words[0] == eight && words[1] == eight && words[2] == eight && words[3] == eight;
}

/// Σ α x^p, p = 0 … 3, of a row of whole blocks, x counted from `origin`.
std::array<double, 4> row_sums(const std::uint8_t* row, int width, double origin) {
  static const std::array<int, 4> kOpaque = [] {
    std::array<std::uint8_t, kBlock> alphas;
    alphas.fill(255);
    return block_sums(alphas.data());
  }();
  std::array<double, 4> sums{};
  for (int start = 0; start < width; start += kBlock) {
    if (all_are(row + start, 0)) continue;
    const auto [s0, s1, s2, s3] = all_are(row + start, ~std::uint64_t{0}) ? kOpaque : block_sums(row + start);
    const double b = start - origin;  // (b + j)^p by the binomial theorem
    sums[0] += s0;
    sums[1] += s1 + b * s0;
    sums[2] += s2 + 2 * b * s1 + b * b * s0;
    sums[3] += s3 + 3 * b * s2 + 3 * b * b * s1 + b * b * b * s0;
  }
  return sums;
}

/// Takes the specks out of the alphas.
void clear_specks(SilhouetteParts& parts) {
  for (const RegionRun& run : parts.runs) {
    if (!parts.is_speck(run.region)) continue;
    std::uint8_t* row = parts.alphas.data() + static_cast<std::ptrdiff_t>(run.y) * parts.stride;
    std::fill(row + run.first, row + run.last + 1, std::uint8_t{0});
  }
}

RawMoments raw_moments(const SilhouetteParts& parts, int height, double origin_x, double origin_y) {
  RawMoments raw;
  for (int y = 0; y < height; ++y)
    raw.add_row(y - origin_y,
                row_sums(parts.alphas.data() + static_cast<std::ptrdiff_t>(y) * parts.stride, parts.stride, origin_x));
  return raw;
}

BoundingBox box_without_specks(const Sprite& sprite, const SilhouetteParts& parts) {
  BoundingBox box;
  for (std::size_t part = 0; part < parts.parts.size(); ++part) {
    if (parts.is_speck(static_cast<int>(part))) continue;
    const BoundingBox& one = parts.parts[part].box;
    if (box.empty()) {
      box = one;
      continue;
    }
    box = {std::min(box.left, one.left), std::min(box.top, one.top), std::max(box.right, one.right),
           std::max(box.bottom, one.bottom)};
  }
  return {box.left + sprite.left, box.top + sprite.top, box.right + sprite.left, box.bottom + sprite.top};
}

void set_central_moments(Silhouette& out, const RawMoments& raw) {
  const double x = raw.m10 / raw.m00, y = raw.m01 / raw.m00, area = raw.m00 / 255;
  const double second = 255 * area * area, third = second * std::sqrt(area);
  out.mu20 = (raw.m20 - x * raw.m10) / second;
  out.mu11 = (raw.m11 - x * raw.m01) / second;
  out.mu02 = (raw.m02 - y * raw.m01) / second;
  out.mu30 = (raw.m30 - 3 * x * raw.m20 + 2 * x * x * raw.m10) / third;
  out.mu21 = (raw.m21 - 2 * x * raw.m11 - y * raw.m20 + 2 * x * x * raw.m01) / third;
  out.mu12 = (raw.m12 - 2 * y * raw.m11 - x * raw.m02 + 2 * y * y * raw.m10) / third;
  out.mu03 = (raw.m03 - 3 * y * raw.m02 + 2 * y * y * raw.m01) / third;
}

}  // namespace

Silhouette measure_silhouette(const Sprite& sprite) {
  SilhouetteParts parts;
  return measure_silhouette(sprite, parts);
}

Silhouette measure_silhouette(const Sprite& sprite, SilhouetteParts& parts) {
  find_parts(sprite, parts);
  Silhouette out;
  if (parts.parts.empty()) return out;
  out.box = box_without_specks(sprite, parts);
  const double origin_x = std::floor((sprite.width - 1) / 2.0), origin_y = std::floor((sprite.height - 1) / 2.0);
  if (parts.parts.size() > 1) clear_specks(parts);
  const RawMoments raw = raw_moments(parts, sprite.height, origin_x, origin_y);
  out.area = raw.m00 / 255;
  out.centroid_x = sprite.left + origin_x + raw.m10 / raw.m00;
  out.centroid_y = sprite.top + origin_y + raw.m01 / raw.m00;
  set_central_moments(out, raw);
  return out;
}

Silhouette mirrored(const Silhouette& silhouette, int frame_width) {
  Silhouette out = silhouette;
  if (silhouette.empty()) return out;
  out.box.left = frame_width - 1 - silhouette.box.right;
  out.box.right = frame_width - 1 - silhouette.box.left;
  out.centroid_x = frame_width - 1 - silhouette.centroid_x;
  out.mu11 = -silhouette.mu11;
  out.mu30 = -silhouette.mu30;
  out.mu12 = -silhouette.mu12;
  return out;
}

}  // namespace motex
