// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/align_sprites.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "motex/core/wide.h"

namespace motex {

namespace {

constexpr int kCoarsest = 48;     // pixels: the longer side of the pictures on which the search begins
constexpr double kSearch = 0.25;  // of the longer side, each way
constexpr double kOtherSize = 0.03;
constexpr double kScaleGain = 0.75 * 0.75;  // of the mean square
constexpr double kGround = 0.1;             // of the height

/// A sprite as floats, R, G, B, alpha side by side, at a place in (halved) pixels.
struct Level {
  int left = 0, top = 0, width = 0, height = 0;
  std::vector<float> values;

  const float* row(int y) const { return &values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) * 4]; }
};

Level level_of(const Sprite& sprite) {
  Level level{sprite.left, sprite.top, sprite.width, sprite.height, {}};
  level.values.reserve(sprite.pixels.size() * 4);
  for (const PremultipliedRgba& pixel : sprite.pixels)
    for (const std::uint8_t value : pixel) level.values.push_back(value);
  return level;
}

int half_down(int i) { return i >> 1; }

Level halved(const Level& full) {
  Level half;
  half.left = half_down(full.left), half.top = half_down(full.top);
  half.width = half_down(full.left + full.width - 1) - half.left + 1;
  half.height = half_down(full.top + full.height - 1) - half.top + 1;
  half.values.assign(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height) * 4, 0);
  for (int y = 0; y < full.height; ++y) {
    const float* from = full.row(y);
    const int row = half_down(full.top + y) - half.top;
    for (int x = 0; x < full.width; ++x) {
      const auto column = static_cast<std::size_t>(half_down(full.left + x) - half.left);
      float* to = &half.values[(static_cast<std::size_t>(row) * static_cast<std::size_t>(half.width) + column) * 4];
      for (std::size_t c = 0; c < 4; ++c) to[c] += from[static_cast<std::size_t>(x) * 4 + c] / 4;
    }
  }
  return half;
}

MOTEX_WIDE float square_of_difference(const float* a, const float* b, std::size_t count) {
  std::array<float, 8> sums{};
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8)
    for (std::size_t k = 0; k < 8; ++k) sums[k] += (a[i + k] - b[i + k]) * (a[i + k] - b[i + k]);
  float sum = ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
  for (; i < count; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

/// Σ_y weight_y (‖a_y‖² + ‖b_y‖²) where they do not meet, ‖a − b‖² where they do, b moved by (dx, dy).
class Comparison {
 public:
  Comparison(const Level& a, const Level& b, double ground_weight) : a_(a), b_(b) {
    ground_ = a.top + a.height - 1 - static_cast<int>(kGround * a.height);
    weight_ = static_cast<float>(ground_weight);
    zeros_.assign(static_cast<std::size_t>(std::max(a.width, b.width)) * 4, 0);
  }

  double mean_square(int dx, int dy) const {
    double sum = 0;
    const int b_top = b_.top + dy, b_left = b_.left + dx;
    const int top = std::min(a_.top, b_top), bottom = std::max(a_.top + a_.height, b_top + b_.height);
    for (int y = top; y < bottom; ++y) {
      const bool in_a = y >= a_.top && y < a_.top + a_.height, in_b = y >= b_top && y < b_top + b_.height;
      double row = 0;
      if (in_a && in_b)
        row = both(a_.row(y - a_.top), b_.row(y - b_top), b_left - a_.left);
      else if (in_a)
        row = alone(a_.row(y - a_.top), a_.width);
      else if (in_b)
        row = alone(b_.row(y - b_top), b_.width);
      sum += y >= ground_ ? weight_ * row : row;
    }
    return sum / (static_cast<double>(a_.values.size() + b_.values.size()) / 2);
  }

 private:
  double alone(const float* row, int width) const {
    return square_of_difference(row, zeros_.data(), static_cast<std::size_t>(std::max(0, width)) * 4);
  }
  /// b begins `shift` pixels to the right of a.
  double both(const float* a, const float* b, int shift) const {
    const int first = std::max(0, shift), last = std::min(a_.width, shift + b_.width);
    if (first >= last) return alone(a, a_.width) + alone(b, b_.width);
    double sum =
        square_of_difference(a + 4 * first, b + 4 * (first - shift), static_cast<std::size_t>(last - first) * 4);
    sum += alone(a, first) + alone(a + 4 * last, a_.width - last);
    sum += alone(b, first - shift) + alone(b + 4 * (last - shift), b_.width - (last - shift));
    return sum;
  }

  const Level& a_;
  const Level& b_;
  int ground_;
  double weight_;
  std::vector<float> zeros_;
};

struct Shift {
  int x = 0, y = 0;
  double mean_square = std::numeric_limits<double>::infinity();
};

Shift best_shift(const Comparison& comparison, int x, int y, int reach_x, int reach_y) {
  Shift best;
  for (int dy = y - reach_y; dy <= y + reach_y; ++dy) {
    for (int dx = x - reach_x; dx <= x + reach_x; ++dx) {
      const double mean_square = comparison.mean_square(dx, dy);
      if (mean_square < best.mean_square) best = {dx, dy, mean_square};
    }
  }
  return best;
}

std::array<double, 2> centroid(const Level& level) {
  double x = 0, y = 0, weight = 1e-9;
  for (int row = 0; row < level.height; ++row) {
    for (int column = 0; column < level.width; ++column) {
      const double alpha = level.row(row)[4 * column + 3];
      x += alpha * column, y += alpha * row, weight += alpha;
    }
  }
  return {level.left + x / weight, level.top + y / weight};
}

Shift search(const Sprite& a, const Sprite& b, double ground_weight) {
  std::vector<Level> as{level_of(a)}, bs{level_of(b)};
  while (std::max({as.back().width, as.back().height, bs.back().width, bs.back().height}) > kCoarsest) {
    as.push_back(halved(as.back()));
    bs.push_back(halved(bs.back()));
  }
  const auto from = centroid(bs.back()), to = centroid(as.back());
  const auto reach = [](int p, int q) { return 1 + static_cast<int>(kSearch * std::max(p, q)); };
  Shift shift =
      best_shift(Comparison(as.back(), bs.back(), ground_weight), static_cast<int>(std::lround(to[0] - from[0])),
                 static_cast<int>(std::lround(to[1] - from[1])), reach(as.back().width, bs.back().width),
                 reach(as.back().height, bs.back().height));
  for (std::size_t level = as.size() - 1; level-- > 0;)
    shift = best_shift(Comparison(as[level], bs[level], ground_weight), 2 * shift.x, 2 * shift.y, 1, 1);
  return shift;
}

double area_of(const Sprite& sprite) {
  double sum = 0;
  for (const PremultipliedRgba& pixel : sprite.pixels) sum += pixel[3];
  return sum;
}

}  // namespace

SpriteAlignment align_sprites(const Sprite& a, const Sprite& b, const AlignSpritesOptions& options) {
  SpriteAlignment result;
  if (a.empty() || b.empty()) return result;
  Shift shift = search(a, b, options.ground_weight);
  const double scale = std::sqrt(area_of(a) / std::max(1.0, area_of(b)));
  const bool other_size =
      std::abs(scale - 1) > kOtherSize && scale <= options.max_scale && scale >= 1 / options.max_scale;
  if (other_size) {
    const Shift scaled = search(a, placed(b, {scale, 0, 0}), options.ground_weight);
    if (scaled.mean_square < kScaleGain * shift.mean_square) {
      shift = scaled;
      result.placement.scale = scale;
    }
  }
  result.placement.x = shift.x, result.placement.y = shift.y;
  result.difference = sprite_difference(a, placed(b, result.placement));
  return result;
}

double sprite_difference(const Sprite& a, const Sprite& b) {
  const BoundingBox box = joined(box_of(a), box_of(b));
  constexpr PremultipliedRgba kNothing{};
  const auto pixel = [&](const Sprite& sprite, int x, int y) {
    x -= sprite.left, y -= sprite.top;
    return x >= 0 && y >= 0 && x < sprite.width && y < sprite.height ? sprite.at(x, y) : kNothing;
  };
  double sum = 0, count = 0;
  for (int y = box.top; y <= box.bottom; ++y) {
    for (int x = box.left; x <= box.right; ++x) {
      const PremultipliedRgba p = pixel(a, x, y), q = pixel(b, x, y);
      if (p[3] == 0 && q[3] == 0) continue;
      ++count;
      for (std::size_t c = 0; c < 4; ++c) sum += (p[c] - q[c]) * (p[c] - q[c]) / 4.0;
    }
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

}  // namespace motex
