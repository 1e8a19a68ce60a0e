// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/core_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace motex {
namespace {

constexpr int kBlock = 8;        // columns
constexpr int kMaxExtent = 176;  // a bar of scale 10 reaches 64 to each side
constexpr double kGaussianReach = 3.2;
constexpr double kWellSampled = 0.9;  // scale above which Σ ψ² d^k is its integral within 10⁻³
constexpr double kDerivativeStep = 1e-3;

struct Box {
  int left = 0, top = 0, width = 0, height = 0;  // width: a multiple of kBlock, may go beyond the picture
  int seen_width = 0;                            // columns in the picture
};

Box box_of(const ResidualFrame& image, double x, double y, int reach_x, int reach_y) {
  Box box;
  const int centre_x = static_cast<int>(std::lround(x)), centre_y = static_cast<int>(std::lround(y));
  box.left = std::max(centre_x - reach_x, 0);
  box.top = std::max(centre_y - reach_y, 0);
  box.seen_width = std::max(0, std::min(centre_x + reach_x + 1, image.width()) - box.left);
  box.height = std::max(0, std::min(centre_y + reach_y + 1, image.height()) - box.top);
  box.width = (box.seen_width + kBlock - 1) / kBlock * kBlock;
  return box;
}

/// e^{−(i + first − centre)²/2s²}, i = 0 … n − 1, zero up to `filled`.
void fill_table(double centre, double inverse_square, double step, int first, int n, int filled, float* out) {
  const double d = first - centre;
  double value = std::exp(-0.5 * d * d * inverse_square), ratio = std::exp(-(d + 0.5) * inverse_square);
  for (int i = 0; i < n; ++i) {
    out[i] = static_cast<float>(value);
    value *= ratio;
    ratio *= step;
  }
  for (int i = n; i < filled; ++i) out[i] = 0;
}

/// The two factors of a round Gaussian of peak 1 over its box.
struct SeparableCore {
  Box box;
  double inverse_square;
  bool is_whole;  ///< not cut by the picture, and smooth enough for sums to be integrals
  alignas(32) float across[kMaxExtent];
  alignas(32) float down[kMaxExtent];

  SeparableCore(const ResidualFrame& image, const CoreState& z) {
    const double scale = std::exp(z[kCoreLogScale]);
    const int reach = std::min(static_cast<int>(std::ceil(kGaussianReach * scale)), kMaxExtent / 2 - kBlock);
    box = box_of(image, z[kCoreX], z[kCoreY], reach, reach);
    inverse_square = 1 / (scale * scale);
    const double step = std::exp(-inverse_square);
    fill_table(z[kCoreX], inverse_square, step, box.left, box.seen_width, box.width, across);
    fill_table(z[kCoreY], inverse_square, step, box.top, box.height, box.height, down);
    is_whole = scale >= kWellSampled && box.seen_width == 2 * reach + 1 && box.height == 2 * reach + 1;
  }
};

double sum_of_squares(const float* values, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += static_cast<double>(values[i]) * static_cast<double>(values[i]);
  return sum;
}

CoreProducts gaussian_products(const ResidualFrame& image, const CoreState& z) {
  const SeparableCore core(image, z);
  CoreProducts products;
  for (int x = 0; x < core.box.width; x += kBlock) {
    float column[kBlock] = {};
    for (int y = 0; y < core.box.height; ++y) {
      const float* row = image.row(core.box.top + y) + core.box.left + x;
      const float weight = core.down[y];
      for (int i = 0; i < kBlock; ++i) column[i] += weight * row[i];
    }
    for (int i = 0; i < kBlock; ++i)
      products.image += static_cast<double>(column[i]) * static_cast<double>(core.across[x + i]);
  }
  products.own = sum_of_squares(core.across, core.box.width) * sum_of_squares(core.down, core.box.height);
  return products;
}

/// Σ ψ² d^k along one axis, k = 0 … 4.
std::array<double, 5> moments(const float* table, int n, double first) {
  std::array<double, 5> sums{};
  for (int i = 0; i < n; ++i) {
    const double d = first + i, square = d * d;
    const double w = static_cast<double>(table[i]) * static_cast<double>(table[i]);
    sums[0] += w;
    sums[1] += w * d;
    sums[2] += w * square;
    sums[3] += w * square * d;
    sums[4] += w * square * square;
  }
  return sums;
}

std::array<double, 5> whole_moments(double inverse_square) {
  const double square = 1 / inverse_square, m = std::sqrt(std::numbers::pi * square);
  return {m, 0, 0.5 * m * square, 0, 0.75 * m * square * square};
}

/// Σ image ψ · (1, dx, dy, r²).
std::array<double, 4> image_moments(const ResidualFrame& image, const SeparableCore& core, double first_x,
                                    double first_y) {
  std::array<double, 4> sums{};
  for (int x = 0; x < core.box.width; x += kBlock) {
    float plain[kBlock] = {}, slope[kBlock] = {}, square[kBlock] = {};
    for (int y = 0; y < core.box.height; ++y) {
      const float* row = image.row(core.box.top + y) + core.box.left + x;
      const auto d = static_cast<float>(first_y + y);
      const float w0 = core.down[y], w1 = w0 * d, w2 = w1 * d;
      for (int i = 0; i < kBlock; ++i) {
        plain[i] += w0 * row[i];
        slope[i] += w1 * row[i];
        square[i] += w2 * row[i];
      }
    }
    for (int i = 0; i < kBlock; ++i) {
      const double d = first_x + x + i, w = static_cast<double>(core.across[x + i]), p = static_cast<double>(plain[i]);
      sums[0] += w * p;
      sums[1] += w * d * p;
      sums[2] += w * static_cast<double>(slope[i]);
      sums[3] += w * (d * d * p + static_cast<double>(square[i]));
    }
  }
  return sums;
}

CoreLinearisation linearise_gaussian(const ResidualFrame& image, const CoreState& z) {
  const SeparableCore core(image, z);
  const double first_x = core.box.left - z[kCoreX], first_y = core.box.top - z[kCoreY];
  const std::array<double, 4> seen = image_moments(image, core, first_x, first_y);
  const std::array<double, 5> h = core.is_whole ? whole_moments(core.inverse_square)
                                                : moments(core.across, core.box.width, first_x),
                              v = core.is_whole ? h : moments(core.down, core.box.height, first_y);
  const double q = core.inverse_square, a = z[kCoreAmplitude];
  // Σ of the products of (dx, dy, r², 1) with one another under ψ²
  const std::array<std::array<double, 4>, 4> own{
      {{h[2] * v[0], h[1] * v[1], h[3] * v[0] + h[1] * v[2], h[1] * v[0]},
       {0, h[0] * v[2], h[2] * v[1] + h[0] * v[3], h[0] * v[1]},
       {0, 0, h[4] * v[0] + 2 * h[2] * v[2] + h[0] * v[4], h[2] * v[0] + h[0] * v[2]},
       {0, 0, 0, h[0] * v[0]}}};
  const std::array<double, 4> factor{a * q, a * q, a * q, 1}, image_sum{seen[1], seen[2], seen[3], seen[0]};
  CoreLinearisation line;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i; j < 4; ++j) line.curvature[i][j] = line.curvature[j][i] = factor[i] * factor[j] * own[i][j];
    line.slope[i] = factor[i] * (image_sum[i] - a * own[i][3]);
  }
  return line;
}

/// ψ of peak 1 of any kind over a box.
class RenderedCore {
 public:
  RenderedCore(const ResidualFrame& image, BaseKind kind, const CoreState& z) : base_(at(kind, z)) {
    const BaseReach reach = reach_of(base_);
    box_ = box_of(image, base_.x, base_.y, reach.x, reach.y);
    render(z, values_);
  }
  const Box& box() const { return box_; }
  const std::vector<float>& values() const { return values_; }
  /// The same box with other parameters.
  void render(const CoreState& z, std::vector<float>& out) const {
    out.resize(static_cast<std::size_t>(box_.seen_width) * static_cast<std::size_t>(box_.height));
    const Base base = at(base_.kind, z);
    evaluate(base, box_.left, box_.top, box_.seen_width, box_.height, out.data());
    double crest = 1;
    if (base.kind == BaseKind::kLog) crest = 2;
    if (base.kind == BaseKind::kGaborCos) crest = 1 - std::exp(-kGaborFrequency * kGaborFrequency / 2);
    if (base.kind == BaseKind::kGaborSin) crest = 0.59501;
    const auto unit = static_cast<float>(1 / crest);
    for (float& value : out) value *= unit;
  }

 private:
  static Base at(BaseKind kind, const CoreState& z) {
    Base base;
    base.kind = kind;
    base.x = z[kCoreX];
    base.y = z[kCoreY];
    base.scale = std::exp(z[kCoreLogScale]);
    base.angle = is_round(kind) ? 0 : z[kCoreAngle];
    return base;
  }

  Base base_;
  Box box_;
  std::vector<float> values_;
};

CoreLinearisation linearise_any(const ResidualFrame& image, BaseKind kind, const CoreState& z) {
  const RenderedCore core(image, kind, z);
  const std::size_t n = core.values().size(), num = is_round(kind) ? kCoreAngle : kNumCoreCoordinates;
  std::array<std::vector<float>, kNumCoreCoordinates> columns;
  const auto a = static_cast<float>(z[kCoreAmplitude]);
  for (std::size_t k = 0; k < num; ++k) {
    if (k == kCoreAmplitude) {
      columns[k] = core.values();
      continue;
    }
    CoreState moved = z;
    moved[k] += kDerivativeStep;
    core.render(moved, columns[k]);
    const float unit = a / static_cast<float>(kDerivativeStep);
    for (std::size_t i = 0; i < n; ++i) columns[k][i] = unit * (columns[k][i] - core.values()[i]);
  }
  CoreLinearisation line;
  for (int y = 0; y < core.box().height; ++y) {
    const float* row = image.row(core.box().top + y) + core.box().left;
    for (int x = 0; x < core.box().seen_width; ++x) {
      const auto at =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(core.box().seen_width) + static_cast<std::size_t>(x);
      const double left = static_cast<double>(row[x] - a * core.values()[at]);
      for (std::size_t i = 0; i < num; ++i) {
        const auto slope = static_cast<double>(columns[i][at]);
        line.slope[i] += slope * left;
        for (std::size_t j = i; j < num; ++j) line.curvature[i][j] += slope * static_cast<double>(columns[j][at]);
      }
    }
  }
  for (std::size_t i = 0; i < num; ++i)
    for (std::size_t j = 0; j < i; ++j) line.curvature[i][j] = line.curvature[j][i];
  return line;
}

}  // namespace

ResidualFrame::ResidualFrame(const Plane& image)
    : width_(image.width),
      height_(image.height),
      stride_(static_cast<std::size_t>((image.width + kBlock - 1) / kBlock * kBlock + kBlock)),
      values_(stride_ * static_cast<std::size_t>(image.height)) {
  for (int y = 0; y < height_; ++y) std::copy_n(image.row(y), width_, row(y));
}

double ResidualFrame::squared_error() const {
  double sum = 0;
  for (const float value : values_) sum += static_cast<double>(value) * static_cast<double>(value);
  return sum;
}

void paint_core(ResidualFrame& image, BaseKind kind, const CoreState& state, float sign) {
  const auto peak = sign * static_cast<float>(state[kCoreAmplitude]);
  if (kind == BaseKind::kGaussian) {
    const SeparableCore core(image, state);
    for (int y = 0; y < core.box.height; ++y) {
      float* row = image.row(core.box.top + y) + core.box.left;
      const float weight = peak * core.down[y];
      for (int x = 0; x < core.box.width; ++x) row[x] += weight * core.across[x];
    }
    return;
  }
  const RenderedCore core(image, kind, state);
  const float* value = core.values().data();
  for (int y = 0; y < core.box().height; ++y) {
    float* row = image.row(core.box().top + y) + core.box().left;
    for (int x = 0; x < core.box().seen_width; ++x) row[x] += peak * *value++;
  }
}

CoreProducts core_products(const ResidualFrame& image, BaseKind kind, const CoreState& state) {
  if (kind == BaseKind::kGaussian) return gaussian_products(image, state);
  const RenderedCore core(image, kind, state);
  CoreProducts products;
  const float* value = core.values().data();
  for (int y = 0; y < core.box().height; ++y) {
    const float* row = image.row(core.box().top + y) + core.box().left;
    for (int x = 0; x < core.box().seen_width; ++x, ++value) {
      products.image += static_cast<double>(*value * row[x]);
      products.own += static_cast<double>(*value * *value);
    }
  }
  return products;
}

double explained_by(const ResidualFrame& image, BaseKind kind, const CoreState& state) {
  const CoreProducts products = core_products(image, kind, state);
  const double peak = state[kCoreAmplitude];
  return peak * (2 * products.image - peak * products.own);
}

CoreLinearisation linearise_core(const ResidualFrame& image, BaseKind kind, const CoreState& state) {
  return kind == BaseKind::kGaussian ? linearise_gaussian(image, state) : linearise_any(image, kind, state);
}

}  // namespace motex
