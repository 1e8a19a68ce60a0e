// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/refine.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace motex {
namespace {

constexpr double kSmallestScale = 0.6, kLargestScale = 10;
constexpr int kMaxParameters = 4;
constexpr int kMaxGradientSteps = 40;
using Parameters = Eigen::Matrix<double, kMaxParameters, 1>;
using Curvature = Eigen::Matrix<double, kMaxParameters, kMaxParameters>;

bool is_round(BaseKind kind) { return kind == BaseKind::kLog || kind == BaseKind::kGaussian; }

/// The pixels that take part, fixed while the base moves a little.
struct Box {
  int left, top, width, height;
  std::size_t area() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

Box box_around(const Base& base, const Plane& image) {
  const BaseReach reach = reach_of(base);
  const int x = static_cast<int>(std::floor(base.x)), y = static_cast<int>(std::floor(base.y));
  const int left = std::max(0, x - reach.x), top = std::max(0, y - reach.y);
  return {left, top, std::min(image.width, x + reach.x + 2) - left, std::min(image.height, y + reach.y + 2) - top};
}

Base moved(Base base, const Parameters& step) {
  base.x += step[0] * base.scale;
  base.y += step[1] * base.scale;
  base.scale = std::clamp(base.scale * std::exp(step[2]), kSmallestScale, kLargestScale);
  base.angle += step[3];
  return base;
}

/// A base on the box with norm 1 there, and its coefficient.
struct Sample {
  std::vector<float> values;
  double coefficient = 0;
};

Sample sample(const Base& base, const Box& box, const std::vector<float>& image) {
  Sample out;
  out.values.resize(box.area());
  evaluate(base, box.left, box.top, box.width, box.height, out.values.data());
  float energy = 0, product = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    energy += out.values[i] * out.values[i];
    product += out.values[i] * image[i];
  }
  const float scale = energy > 1e-12F ? 1 / std::sqrt(energy) : 0;
  for (float& value : out.values) value *= scale;
  out.coefficient = static_cast<double>(product) * scale;
  return out;
}

/// JᵀJ and Jᵀe of the error image − α b with α eliminated: the part of each derivative across b.
void linearise(const Base& base, const Sample& now, const Box& box, const std::vector<float>& image,
               Curvature& curvature, Parameters& slope) {
  constexpr double kStep = 0.02;
  const int num = is_round(base.kind) ? 3 : 4;
  std::vector<std::vector<float>> derivatives;
  for (int k = 0; k < num; ++k) {
    Parameters step = Parameters::Zero();
    step[k] = kStep;
    derivatives.push_back(sample(moved(base, step), box, image).values);
    float along = 0;
    for (std::size_t i = 0; i < image.size(); ++i) along += derivatives.back()[i] * now.values[i];
    for (std::size_t i = 0; i < image.size(); ++i)
      derivatives.back()[i] =
          (derivatives.back()[i] - along * now.values[i]) * static_cast<float>(now.coefficient / kStep);
  }
  curvature.setIdentity();
  slope.setZero();
  for (int k = 0; k < num; ++k) {
    const std::vector<float>& d = derivatives[static_cast<std::size_t>(k)];
    float dot = 0;
    for (std::size_t i = 0; i < image.size(); ++i) dot += d[i] * image[i];
    slope[k] = dot;  // the derivative is across b, so ⟨d, α b⟩ = 0
    for (int m = 0; m <= k; ++m) {
      const std::vector<float>& other = derivatives[static_cast<std::size_t>(m)];
      float product = 0;
      for (std::size_t i = 0; i < image.size(); ++i) product += d[i] * other[i];
      curvature(k, m) = curvature(m, k) = product;
    }
  }
}

/// The angle in [0, π). Half a turn changes the sign of Gsin alone, which its coefficient takes up.
void normalise_angle(Base& base) {
  if (is_round(base.kind)) base.angle = 0;
  base.angle -= std::numbers::pi * std::floor(base.angle / std::numbers::pi);
  if (base.angle >= std::numbers::pi) base.angle = 0;
}

bool is_inside(const Base& base, const Plane& image) {
  return base.x >= -0.5 && base.y >= -0.5 && base.x <= image.width - 0.5 && base.y <= image.height - 0.5;
}

Base climbed(const Plane& image, const Base& start, int num_steps) {
  const Box box = box_around(start, image);
  std::vector<float> pixels;
  pixels.reserve(box.area());
  for (int y = 0; y < box.height; ++y) {
    const float* row = image.row(box.top + y) + box.left;
    pixels.insert(pixels.end(), row, row + box.width);
  }
  Base best = start;
  Sample now = sample(best, box, pixels);
  double damping = 1e-2;
  Curvature curvature;
  Parameters slope;
  bool is_new = true;
  for (int step = 0; step < num_steps; ++step) {
    if (is_new) linearise(best, now, box, pixels, curvature, slope);
    Curvature damped = curvature;
    damped.diagonal() *= 1 + damping;
    Parameters change = damped.ldlt().solve(slope);
    const double largest = change.cwiseAbs().maxCoeff();
    if (!std::isfinite(largest)) break;
    if (largest > 0.4) change *= 0.4 / largest;
    const Base next = moved(best, change);
    Sample there = sample(next, box, pixels);
    const double gain = std::abs(there.coefficient) - std::abs(now.coefficient);
    is_new = gain > 0 && is_inside(next, image);
    damping *= is_new ? 0.3 : 10;
    if (!is_new) continue;
    best = next;
    now = std::move(there);
    if (largest < 0.01) break;
  }
  return best;
}

/// residual −= Σ weights_j patch_j.
void subtract(Plane& residual, const std::vector<BasePatch>& patches, const std::vector<float>& weights, float sign) {
  for (std::size_t j = 0; j < patches.size(); ++j) add_patch(residual, patches[j], -sign * weights[j]);
}

double dot(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i]) * b[i];
  return sum;
}

}  // namespace

FittedBase refine_base(const Plane& image, const Base& start, int num_steps) {
  FittedBase out{num_steps > 0 ? climbed(image, start, num_steps) : start, {}, 0};
  normalise_angle(out.base);
  out.patch = render_patch(out.base, image.width, image.height);
  const double energy = energy_of(out.patch);
  out.coefficient = energy > 0.01 ? static_cast<float>(inner_product(out.patch, image) / energy) : 0;
  return out;
}

std::vector<float> fit_coefficients(const Plane& image, const std::vector<BasePatch>& patches,
                                    const std::vector<float>& start) {
  std::vector<float> coefficients = start;
  Plane residual = image;
  subtract(residual, patches, coefficients, 1);
  std::vector<float> slope(patches.size());
  const auto correlate = [&] {
    for (std::size_t j = 0; j < patches.size(); ++j) slope[j] = inner_product(patches[j], residual);
  };
  correlate();
  std::vector<float> direction = slope;
  double slope_energy = dot(slope, slope);
  const double enough = 1e-6 * slope_energy;
  for (int step = 0; step < kMaxGradientSteps && slope_energy > enough && slope_energy > 0; ++step) {
    Plane image_of_direction(image.width, image.height);
    subtract(image_of_direction, patches, direction, -1);
    const double energy = sum_of_squares(image_of_direction);
    if (energy <= 0) break;
    const auto length = static_cast<float>(slope_energy / energy);
    for (std::size_t j = 0; j < coefficients.size(); ++j) coefficients[j] += length * direction[j];
    for (std::size_t i = 0; i < residual.values.size(); ++i)
      residual.values[i] -= length * image_of_direction.values[i];
    correlate();
    const double next_energy = dot(slope, slope);
    const auto turn = static_cast<float>(next_energy / slope_energy);
    for (std::size_t j = 0; j < direction.size(); ++j) direction[j] = slope[j] + turn * direction[j];
    slope_energy = next_energy;
  }
  return coefficients;
}

}  // namespace motex
