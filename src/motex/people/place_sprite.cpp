// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/wide.h"
#include "motex/people/warp_sprites.h"

namespace motex {

namespace {

/// Four neighbours of a place along a side, with their weights.
struct Taps {
  std::array<int, 4> at{};  // cut to the side
  std::array<float, 4> weight{};
};

/// Catmull–Rom; weights of neighbours outside are 0: there is nothing.
Taps taps_at(double place, int size) {
  const double whole = std::floor(place), t = place - whole;
  const std::array<double, 4> weight{t * (-0.5 + t * (1 - 0.5 * t)), 1 + t * t * (-2.5 + 1.5 * t),
                                     t * (0.5 + t * (2 - 1.5 * t)), t * t * (-0.5 + 0.5 * t)};
  Taps taps;
  for (std::size_t k = 0; k < 4; ++k) {
    const int i = static_cast<int>(whole) - 1 + static_cast<int>(k);
    taps.at[k] = std::clamp(i, 0, size - 1);
    taps.weight[k] = i == taps.at[k] ? static_cast<float>(weight[k]) : 0.0F;
  }
  return taps;
}

std::vector<Taps> taps_along(int first, int count, double scale, double offset, int sprite_first, int size) {
  std::vector<Taps> taps;
  taps.reserve(static_cast<std::size_t>(count));
  for (int i = first; i < first + count; ++i) taps.push_back(taps_at((i - offset) / scale - sprite_first, size));
  return taps;
}

MOTEX_WIDE void resample_row(const PremultipliedRgba* row, const std::vector<Taps>& taps, float* out) {
  for (const Taps& tap : taps) {
    for (std::size_t c = 0; c < 4; ++c) {
      float sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += tap.weight[k] * static_cast<float>(row[tap.at[k]][c]);
      *out++ = sum;
    }
  }
}

MOTEX_WIDE void mix_rows(const std::array<const float*, 4>& rows, const std::array<float, 4>& weight, std::size_t count,
                         float* out) {
  const float *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3];
  const float wa = weight[0], wb = weight[1], wc = weight[2], wd = weight[3];
  for (std::size_t i = 0; i < count; ++i) out[i] = wa * a[i] + wb * b[i] + (wc * c[i] + wd * d[i]);
}

/// Overshoot is cut off: 0 … 255, colours no brighter than alpha.
void round_row(const std::vector<float>& row, PremultipliedRgba* out) {
  for (std::size_t i = 0; i < row.size(); i += 4) {
    const float alpha = std::clamp(row[i + 3], 0.0F, 255.0F);
    for (std::size_t c = 0; c < 4; ++c)
      out[i / 4][c] = static_cast<std::uint8_t>(std::clamp(row[i + c], 0.0F, alpha) + 0.5F);
  }
}

}  // namespace

Sprite placed(const Sprite& sprite, const Placement& placement) {
  if (!(placement.scale > 0.01 && placement.scale < 100) || !(std::abs(placement.x) < 1e6) ||
      !(std::abs(placement.y) < 1e6))
    throw InvalidInput("a sprite can be scaled by 0.01 to 100 and moved by a million pixels");
  if (sprite.empty()) return {};
  Sprite out;
  if (placement.is_whole_pixels()) {
    out = sprite;
    out.left += static_cast<int>(placement.x), out.top += static_cast<int>(placement.y);
    return out;
  }
  const BoundingBox box = box_of(sprite, placement);
  out.left = box.left, out.top = box.top, out.width = box.width(), out.height = box.height();
  out.pixels.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  const std::vector<Taps> across =
      taps_along(out.left, out.width, placement.scale, placement.x, sprite.left, sprite.width);
  const std::vector<Taps> down =
      taps_along(out.top, out.height, placement.scale, placement.y, sprite.top, sprite.height);
  const auto stride = static_cast<std::size_t>(out.width) * 4;
  std::vector<float> wide(stride * static_cast<std::size_t>(sprite.height)), row(stride);
  for (int y = 0; y < sprite.height; ++y)
    resample_row(&sprite.at(0, y), across, &wide[stride * static_cast<std::size_t>(y)]);
  for (int y = 0; y < out.height; ++y) {
    const Taps& taps = down[static_cast<std::size_t>(y)];
    std::array<const float*, 4> rows{};
    for (std::size_t k = 0; k < 4; ++k) rows[k] = &wide[stride * static_cast<std::size_t>(taps.at[k])];
    mix_rows(rows, taps.weight, stride, row.data());
    round_row(row, &out.at(0, y));
  }
  return out;
}

}  // namespace motex
