// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/blob_peaks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace motex {
namespace {

constexpr double kFirstSigma = 0.8;
constexpr double kScaleOfLevel = 0.78;  // a spot of that many a peaks highest at level a

/// Convolution with a Gaussian along rows, then columns; edge pixels repeated. Buffers are kept between calls.
class Blur {
 public:
  void apply(const Plane& in, double sigma, Plane& out) {
    const int reach = std::max(1, static_cast<int>(std::ceil(3.2 * sigma)));
    make_kernel(sigma, reach);
    const int width = in.width, height = in.height;
    if (out.width != width || out.height != height) out = Plane(width, height);
    rows_.resize(in.values.size());
    padded_.resize(static_cast<std::size_t>(width + 2 * reach));
    for (int y = 0; y < height; ++y) {
      const float* row = in.row(y);
      std::fill_n(padded_.begin(), reach, row[0]);
      std::copy(row, row + width, padded_.begin() + reach);
      std::fill_n(padded_.begin() + reach + width, reach, row[width - 1]);
      const float* middle = padded_.data() + reach;
      float* target = rows_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
      for (int x = 0; x < width; ++x) target[x] = kernel_[0] * middle[x];
      for (int k = 1; k <= reach; ++k) add(middle - k, middle + k, kernel_[static_cast<std::size_t>(k)], target, width);
    }
    const auto row_at = [&](int y) {
      return rows_.data() + static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * static_cast<std::size_t>(width);
    };
    for (int y = 0; y < height; ++y) {
      float* target = out.row(y);
      const float* middle = row_at(y);
      for (int x = 0; x < width; ++x) target[x] = kernel_[0] * middle[x];
      for (int k = 1; k <= reach; ++k)
        add(row_at(y - k), row_at(y + k), kernel_[static_cast<std::size_t>(k)], target, width);
    }
  }

 private:
  void make_kernel(double sigma, int reach) {
    kernel_.resize(static_cast<std::size_t>(reach) + 1);
    double sum = 0;
    for (int k = 0; k <= reach; ++k) {
      const double value = std::exp(-k * k / (2 * sigma * sigma));
      kernel_[static_cast<std::size_t>(k)] = static_cast<float>(value);
      sum += k == 0 ? value : 2 * value;
    }
    for (float& value : kernel_) value = static_cast<float>(static_cast<double>(value) / sum);
  }
  static void add(const float* a, const float* b, float weight, float* target, int width) {
    for (int x = 0; x < width; ++x) target[x] += weight * (a[x] + b[x]);
  }

  std::vector<float> kernel_, rows_, padded_;
};

/// One level: D = (G_a − G_2a) * image in deviations of noise, on every `step`-th pixel.
struct Level {
  Plane response;
  double a = 1;
  int step = 1;
};

/// ‖G_a − G_b‖ in the plane, in original pixels.
double norm_of(double a, double b) {
  return std::sqrt((1 / (4 * a * a) + 1 / (4 * b * b) - 1 / (a * a + b * b)) / std::numbers::pi);
}

Plane every_second(const Plane& in) {
  Plane out((in.width + 1) / 2, (in.height + 1) / 2);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) out.at(x, y) = in.at(2 * x, 2 * y);
  return out;
}

std::vector<Level> make_levels(const Plane& image, double max_scale) {
  constexpr double kRoot = std::numbers::sqrt2;
  std::vector<Level> levels;
  Blur blur;
  Plane l0, l1, l2, l3;
  blur.apply(image, kFirstSigma, l0);
  for (int step = 1; step * kFirstSigma * kScaleOfLevel <= max_scale * 1.01 && std::min(l0.width, l0.height) >= 4;
       step *= 2) {
    // in pixels of this octave: 0.8, 1.13, 1.6, 2.26
    blur.apply(l0, kFirstSigma, l1);
    blur.apply(l1, kFirstSigma * kRoot, l2);
    blur.apply(l2, 2 * kFirstSigma, l3);
    const auto difference = [&](const Plane& fine, const Plane& coarse, double a) {
      Level level{Plane(fine.width, fine.height), a * step, step};
      const auto weight = static_cast<float>(1 / norm_of(level.a, 2 * level.a));
      for (std::size_t i = 0; i < fine.values.size(); ++i)
        level.response.values[i] = weight * (fine.values[i] - coarse.values[i]);
      levels.push_back(std::move(level));
    };
    difference(l0, l2, kFirstSigma);
    difference(l1, l3, kFirstSigma * kRoot);
    l0 = every_second(l2);
  }
  return levels;
}

/// Largest value of the 3 × 3 (on a finer grid 5 × 5) neighbours in another level.
float largest_near(const Level& level, int x, int y, int reach) {
  const Plane& plane = level.response;
  float best = -std::numeric_limits<float>::infinity();
  for (int v = std::max(0, y - reach); v <= std::min(plane.height - 1, y + reach); ++v)
    for (int u = std::max(0, x - reach); u <= std::min(plane.width - 1, x + reach); ++u)
      best = std::max(best, plane.at(u, v));
  return best;
}

double top_of_parabola(double left, double middle, double right) {
  const double bend = left - 2 * middle + right;
  return bend < 0 ? std::clamp(0.5 * (left - right) / bend, -0.5, 0.5) : 0;
}

void collect(const std::vector<Level>& levels, double threshold, double sign, std::vector<BlobPeak>& peaks) {
  for (std::size_t j = 0; j < levels.size(); ++j) {
    const Level& level = levels[j];
    const Plane& plane = level.response;
    for (int y = 0; y < plane.height; ++y)
      for (int x = 0; x < plane.width; ++x) {
        const float value = plane.at(x, y);
        if (static_cast<double>(value) < threshold || largest_near(level, x, y, 1) > value) continue;
        bool is_peak = true;
        for (const std::size_t other : {j - 1, j + 1}) {
          if (other >= levels.size()) continue;
          const int from = level.step, to = levels[other].step;
          is_peak = is_peak && largest_near(levels[other], (x * from + to / 2) / to, (y * from + to / 2) / to,
                                            from > to ? 2 : 1) <= value;
        }
        if (!is_peak) continue;
        const auto at = [&](int u, int v) {
          return static_cast<double>(plane.at(std::clamp(u, 0, plane.width - 1), std::clamp(v, 0, plane.height - 1)));
        };
        const double s = kScaleOfLevel * level.a, a = level.a;
        const double height = s * s / (s * s + a * a) - s * s / (s * s + 4 * a * a);
        peaks.push_back({(x + top_of_parabola(at(x - 1, y), at(x, y), at(x + 1, y))) * level.step,
                         (y + top_of_parabola(at(x, y - 1), at(x, y), at(x, y + 1))) * level.step, s,
                         static_cast<double>(value), sign * static_cast<double>(value) * norm_of(a, 2 * a) / height});
      }
  }
}

}  // namespace

std::vector<BlobPeak> find_blob_peaks(const Plane& image, double max_scale, double threshold, bool both_signs) {
  std::vector<BlobPeak> peaks;
  if (image.width < 1 || image.height < 1) return peaks;
  std::vector<Level> levels = make_levels(image, max_scale);
  collect(levels, threshold, 1, peaks);
  if (both_signs) {
    for (Level& level : levels)
      for (float& value : level.response.values) value = -value;
    collect(levels, threshold, -1, peaks);
  }
  std::sort(peaks.begin(), peaks.end(), [](const BlobPeak& a, const BlobPeak& b) {
    return std::make_tuple(-a.response, a.y, a.x, a.scale) < std::make_tuple(-b.response, b.y, b.x, b.scale);
  });
  return peaks;
}

}  // namespace motex
