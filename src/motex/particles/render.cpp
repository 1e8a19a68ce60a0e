// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/render.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr int kLanes = 4;  // pixels at a time
constexpr double kMaxReach = 30000;

/// e^{−d²/2s²} at d = first, first + 1, … by multiplication: the exponent is a square polynomial.
class BellWalk {
 public:
  BellWalk(double first, double scale) {
    const double inverse = 1 / (2 * scale * scale);
    value_ = std::exp(-first * first * inverse);
    ratio_ = std::exp(-(2 * first + 1) * inverse);
    step_ = std::exp(-2 * inverse);
  }
  double next() {
    const double value = value_;
    value_ *= ratio_;
    ratio_ *= step_;
    return value;
  }

 private:
  double value_, ratio_, step_;
};

/// Σ g², Σ g h, Σ h² along an axis, g = e^{−d²/2s²}, h = (1 − d²/s²) g, over the box of the base.
struct AxisSums {
  double gg = 0, gh = 0, hh = 0;
};

AxisSums axis_sums(double centre, double scale, int reach) {
  AxisSums sums;
  double d = std::floor(centre) - reach - centre;
  BellWalk bell(d, scale);
  const double inverse = 1 / (scale * scale);
  for (int k = 0; k < 2 * reach + 2; ++k, d += 1) {
    const double g = bell.next(), h = (1 - d * d * inverse) * g;
    sums.gg += g * g;
    sums.gh += g * h;
    sums.hh += h * h;
  }
  return sums;
}

/// ‖ψ‖ over the pixels of the original resolution.
double norm_of_round(const Base& base) {
  const int reach = reach_of(base).x;
  const AxisSums x = axis_sums(base.x, base.scale, reach), y = axis_sums(base.y, base.scale, reach);
  const double energy = base.kind == BaseKind::kGaussian ? x.gg * y.gg : x.hh * y.gg + 2 * x.gh * y.gh + x.gg * y.hh;
  return std::sqrt(energy);
}

Base magnified(const Base& base, double m) {
  Base out = base;
  out.x = m * (base.x + 0.5) - 0.5;
  out.y = m * (base.y + 0.5) - 0.5;
  out.scale = m * base.scale;
  return out;
}

struct Box {
  int left = 0, top = 0, width = 0, height = 0;
};

Box box_of(const Base& base) {
  const BaseReach reach = reach_of(base);
  return {static_cast<int>(std::floor(base.x)) - reach.x, static_cast<int>(std::floor(base.y)) - reach.y,
          2 * reach.x + 2, 2 * reach.y + 2};
}

Box cut(const Box& box, const Plane& plane) {
  Box out;
  out.left = std::max(box.left, 0);
  out.top = std::max(box.top, 0);
  out.width = std::min(box.left + box.width, plane.width) - out.left;
  out.height = std::min(box.top + box.height, plane.height) - out.top;
  return out;
}

bool is_drawable(const Base& base, double magnification) {
  const bool finite = std::isfinite(base.x) && std::isfinite(base.y) && std::isfinite(base.angle);
  return finite && base.scale > 0 && base.scale * magnification < kMaxReach / 8 &&
         std::abs(base.x * magnification) < 1e8 && std::abs(base.y * magnification) < 1e8;
}

}  // namespace

BaseRenderer::BaseRenderer(double magnification, int num_base_planes)
    : magnification_(magnification), num_base_planes_(num_base_planes) {
  if (!(magnification >= 1.0 / 64 && magnification <= 64))
    throw InvalidInput("the resolution can be magnified 1/64 to 64 times, not " + std::to_string(magnification));
}

void BaseRenderer::add(std::span<const Base> bases, Planes& planes) {
  if (planes.size() != 1 && planes.size() != 3) throw InvalidInput("bases are drawn onto 1 or 3 planes");
  for (const Base& base : bases) {
    if (!is_drawable(base, magnification_)) continue;
    is_oriented(base.kind) ? add_oriented(base, planes) : add_round(base, planes);
  }
}

void BaseRenderer::add_round(const Base& base, Planes& planes) {
  const Base drawn = magnified(base, magnification_);
  const Box box = cut(box_of(drawn), planes[0]);
  if (box.width <= 0 || box.height <= 0) return;
  const bool is_log = base.kind == BaseKind::kLog;
  const double inverse = 1 / (drawn.scale * drawn.scale), norm = norm_of_round(base);
  bell_.resize(std::max(bell_.size(), static_cast<std::size_t>(box.width)));
  hat_.resize(bell_.size());
  double d = box.left - drawn.x;
  BellWalk across(d, drawn.scale);
  for (std::size_t x = 0; x < static_cast<std::size_t>(box.width); ++x, d += 1) {
    const double g = across.next();
    bell_[x] = static_cast<float>(g);
    if (is_log) hat_[x] = static_cast<float>((1 - d * d * inverse) * g);
  }
  d = box.top - drawn.y;
  BellWalk down(d, drawn.scale);
  const float *const bell = bell_.data(), *const hat = hat_.data();
  for (int y = 0; y < box.height; ++y, d += 1) {
    const double g = down.next() / norm;
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const auto of_bell = static_cast<float>(g * (is_log ? 1 - d * d * inverse : 1)) * coefficient(base, k);
      const auto of_hat = static_cast<float>(g) * coefficient(base, k);
      float* const row = planes[k].row(box.top + y) + box.left;
      if (is_log)
        for (int x = 0; x < box.width; ++x) row[x] += of_bell * bell[x] + of_hat * hat[x];
      else
        for (int x = 0; x < box.width; ++x) row[x] += of_bell * bell[x];
    }
  }
}

/// ψ without its norm into patch_, rows padded to whole lanes, and Σ ψ² of the box. With d the place from the centre,
/// the envelope is e^{−(a dx² + 2 b dx dy + c dy²)}: tables in x and y and, in a row, a power in x; the wave's phase is
/// a sum of a term in x and one in y. A streak is a Gcos of frequency and mean zero.
double BaseRenderer::evaluate_oriented(const Base& base, int left, int top, int width, int height) {
  const double cos = std::cos(base.angle), sin = std::sin(base.angle), half = 1 / (2 * base.scale * base.scale);
  const double a = (cos * cos + sin * sin / 4) * half, b = 0.75 * cos * sin * half;
  const bool is_sine = base.kind == BaseKind::kGaborSin, is_streak = base.kind == BaseKind::kStreak;
  const double c = (sin * sin + cos * cos / 4) * half, frequency = is_streak ? 0 : kGaborFrequency / base.scale;
  const auto stride = static_cast<std::size_t>((width + kLanes - 1) / kLanes * kLanes);
  for (std::vector<float>* table : {&bell_, &wave_cos_, &wave_sin_}) table->resize(std::max(table->size(), stride));
  patch_.resize(std::max(patch_.size(), stride * static_cast<std::size_t>(height)));
  const double first_x = left - base.x;
  BellWalk across(first_x, std::sqrt(1 / (2 * a)));
  double wave_cos = std::cos(frequency * cos * first_x), wave_sin = std::sin(frequency * cos * first_x);
  const double turn_cos = std::cos(frequency * cos), turn_sin = std::sin(frequency * cos);
  for (std::size_t x = 0; x < stride; ++x) {
    bell_[x] = x < static_cast<std::size_t>(width) ? static_cast<float>(across.next()) : 0.0F;
    wave_cos_[x] = static_cast<float>(wave_cos);
    wave_sin_[x] = static_cast<float>(wave_sin);
    const double next_cos = wave_cos * turn_cos - wave_sin * turn_sin;
    wave_sin = wave_sin * turn_cos + wave_cos * turn_sin;
    wave_cos = next_cos;
  }

  const double first_y = top - base.y;
  BellWalk down(first_y, std::sqrt(1 / (2 * c)));
  double skew = std::exp(-2 * b * first_x * first_y), power = std::exp(-2 * b * first_y);
  const double skew_step = std::exp(-2 * b * first_x), power_step = std::exp(-2 * b);
  const auto mean = static_cast<float>(is_sine || is_streak ? 0 : std::exp(-kGaborFrequency * kGaborFrequency / 2));
  double energy = 0;
  for (int y = 0; y < height; ++y) {
    const double phase = frequency * sin * (first_y + y), at = down.next() * skew;
    // cos(p + q) = cos p cos q − sin p sin q, sin(p + q) = cos p sin q + sin p cos q
    const auto of_cos = static_cast<float>(is_sine ? std::sin(phase) : std::cos(phase));
    const auto of_sin = static_cast<float>(is_sine ? std::cos(phase) : -std::sin(phase));
    std::array<float, kLanes> lanes{}, sums{};
    for (std::size_t k = 0; k < kLanes; ++k)
      lanes[k] = static_cast<float>(at * (k == 0   ? 1
                                          : k == 1 ? power
                                          : k == 2 ? power * power
                                                   : power * power * power));
    const auto lane_step = static_cast<float>(power * power * power * power);
    float* const out = patch_.data() + static_cast<std::size_t>(y) * stride;
    const float *const bell = bell_.data(), *const cosines = wave_cos_.data(), *const sines = wave_sin_.data();
    for (std::size_t x = 0; x < stride; x += kLanes)
      for (std::size_t k = 0; k < kLanes; ++k) {
        const float value = bell[x + k] * lanes[k] * (of_cos * cosines[x + k] + of_sin * sines[x + k] - mean);
        out[x + k] = value;
        sums[k] += value * value;
        lanes[k] *= lane_step;
      }
    energy += static_cast<double>((sums[0] + sums[1]) + (sums[2] + sums[3]));
    skew *= skew_step;
    power *= power_step;
  }
  return energy;
}

void BaseRenderer::add_oriented(const Base& base, Planes& planes) {
  const Base drawn = magnified(base, magnification_);
  const Box whole = box_of(drawn), box = cut(whole, planes[0]);
  if (box.width <= 0 || box.height <= 0) return;
  double energy = 0;
  if (magnification_ != 1) {
    const Box original = box_of(base);
    energy = evaluate_oriented(base, original.left, original.top, original.width, original.height);
    evaluate_oriented(drawn, whole.left, whole.top, whole.width, whole.height);
  } else {
    energy = evaluate_oriented(drawn, whole.left, whole.top, whole.width, whole.height);
  }
  if (!(energy > 0)) return;
  const double norm = std::sqrt(energy);
  const auto stride = static_cast<std::size_t>((whole.width + kLanes - 1) / kLanes * kLanes);
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const auto weight = static_cast<float>(static_cast<double>(coefficient(base, k)) / norm);
    for (int y = 0; y < box.height; ++y) {
      const float* const source =
          patch_.data() + static_cast<std::size_t>(box.top + y - whole.top) * stride + (box.left - whole.left);
      float* const row = planes[k].row(box.top + y) + box.left;
      for (int x = 0; x < box.width; ++x) row[x] += weight * source[x];
    }
  }
}

}  // namespace motex
