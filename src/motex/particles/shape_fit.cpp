// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/shape_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

namespace motex {
namespace {

constexpr int kMostSteps = 8;
constexpr std::size_t kMostTried = 2;  // shapes that are fitted: those that fit best as they are
constexpr double kEnoughGain = 0.3;    // of the squared error in squared noises: less is not worth a step
constexpr double kUnder = 0.1;         // of the amplitude: what lies under an element
constexpr double kSettled = 0.05;      // scales: a shift that does not touch the neighbours

using Matrix5 = Eigen::Matrix<double, 5, 5>;
using Vector5 = Eigen::Matrix<double, 5, 1>;

std::array<double, 5> values_of(const ShapedElement& e) { return {e.x, e.y, e.log_scale, e.amplitude, e.turn}; }

double prior_cost(const ShapedElement& element, const ShapedPrior& prior) {
  const std::array<double, 5> values = values_of(element);
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double off = values[i] - prior.mean[i];
    sum += prior.precision[i] * off * off;
  }
  return sum;
}

ShapedElement moved(const ShapedElement& element, const Vector5& change) {
  const double scale = std::exp(element.log_scale);
  ShapedElement out = element;
  out.x += std::clamp(change[0], -0.7 * scale, 0.7 * scale);
  out.y += std::clamp(change[1], -0.7 * scale, 0.7 * scale);
  out.log_scale += std::clamp(change[2], -0.3, 0.3);
  out.amplitude += change[3];
  out.turn += std::clamp(change[4], -0.3, 0.3);
  return out;
}

/// Where low ≤ start + slope · d ≤ high, of first ≤ d ≤ last.
void cut(double start, double slope, double low, double high, double& first, double& last) {
  if (std::abs(slope) < 1e-9) {
    if (start < low || start > high) last = first - 1;
    return;
  }
  const double a = (low - start) / slope, b = (high - start) / slope;
  first = std::max(first, std::min(a, b));
  last = std::min(last, std::max(a, b));
}

}  // namespace

ShapeFitter::ShapeFitter(const Plane& image, const ElementShapes& shapes, double noise)
    : shapes_(&shapes), noise_(noise), left_(image) {}

ShapeFitter::Box ShapeFitter::box_of(const ShapedElement& element) const {
  const double reach = shapes_->shapes[static_cast<std::size_t>(element.shape)].reach() * std::exp(element.log_scale);
  const auto low = [](double value) { return std::max(0, static_cast<int>(std::ceil(value))); };
  const auto high = [](double value, int size) { return std::min(size, static_cast<int>(std::floor(value)) + 1); };
  Box box{low(element.x - reach), low(element.y - reach), high(element.x + reach, left_.width),
          high(element.y + reach, left_.height)};
  box.right = std::max(box.left, box.right);
  box.bottom = std::max(box.top, box.bottom);
  return box;
}

template <typename Visit>
void ShapeFitter::for_each_pixel(const ShapedElement& element, const Visit& visit, int row_step) const {
  const Box box = box_of(element);
  const double scale = std::exp(element.log_scale), inverse = 1 / scale;
  const double along = std::cos(element.turn) * inverse, across = std::sin(element.turn) * inverse;
  const ShapeGrid& shape = shapes_->shapes[static_cast<std::size_t>(element.shape)];
  const ShapeGrid::Extent& extent = shape.extent();
  for (int y = box.top; y < box.bottom; y += row_step) {
    // u and v go linearly along the row: where both are inside the extent.
    const double dy = y - element.y, u_start = across * dy, v_start = along * dy;
    double first = box.left - element.x, last = box.right - 1 - element.x;
    cut(u_start, along, extent.left, extent.right, first, last);
    cut(v_start, -across, extent.top, extent.bottom, first, last);
    for (int x = static_cast<int>(std::ceil(element.x + first)); x <= element.x + last; ++x) {
      const double dx = x - element.x, u = u_start + along * dx, v = v_start - across * dx;
      visit(x, y, u, v, shape.at(u, v));
    }
  }
}

void ShapeFitter::paint(const ShapedElement& element, float sign) {
  const float weight = sign * static_cast<float>(element.amplitude);
  for_each_pixel(element,
                 [&](int x, int y, double, double, const ShapeGrid::Point& p) { left_.row(y)[x] -= weight * p.value; });
}

/// Change of the cost when the element is added to what there is, by every other row.
double ShapeFitter::rough_cost(const ShapedElement& element, const ShapedPrior& prior) const {
  constexpr int kRowStep = 2;
  double sum = 0;
  for_each_pixel(
      element,
      [&](int x, int y, double, double, const ShapeGrid::Point& p) {
        const double value = element.amplitude * static_cast<double>(p.value);
        sum += value * (value - 2 * static_cast<double>(left_.at(x, y)));
      },
      kRowStep);
  return kRowStep * sum / (noise_ * noise_) + prior_cost(element, prior);
}

/// What Gauss–Newton needs at one place of the five numbers.
struct ShapeFitter::Slopes {
  double cost = 0;
  std::array<double, 15> products{};  ///< of the derivatives, lower triangle
  std::array<double, 5> slopes{};     ///< derivatives times what is left
};

ShapeFitter::Slopes ShapeFitter::slopes_at(const ShapedElement& element, const ShapedPrior& prior) const {
  Slopes out;
  const double inverse = std::exp(-element.log_scale), a = element.amplitude;
  const double c = std::cos(element.turn) * inverse, s = std::sin(element.turn) * inverse;
  double sum = 0;
  for_each_pixel(element, [&](int x, int y, double u, double v, const ShapeGrid::Point& p) {
    const auto along_u = static_cast<double>(p.along_u), along_v = static_cast<double>(p.along_v);
    const auto value = static_cast<double>(p.value);
    if (value == 0 && along_u == 0 && along_v == 0) return;
    const std::array<double, 5> d{-a * (c * along_u - s * along_v), -a * (s * along_u + c * along_v),
                                  -a * (u * along_u + v * along_v), value, a * (v * along_u - u * along_v)};
    const double light = static_cast<double>(left_.at(x, y)), painted = a * value, rest = light - painted;
    sum += painted * (painted - 2 * light);
    for (std::size_t i = 0, k = 0; i < 5; ++i) {
      out.slopes[i] += d[i] * rest;
      for (std::size_t j = 0; j <= i; ++j, ++k) out.products[k] += d[i] * d[j];
    }
  });
  out.cost = sum / (noise_ * noise_) + prior_cost(element, prior);
  return out;
}

double ShapeFitter::solve(ShapedElement& element, const ShapedPrior& prior, int num_steps) const {
  Slopes now = slopes_at(element, prior);
  double damping = 1e-3;
  Matrix5 curvature = Matrix5::Identity();
  for (int step = 0; step < num_steps; ++step) {
    const double weight = 1 / (noise_ * noise_);
    const std::array<double, 5> values = values_of(element);
    Vector5 slope;
    for (int i = 0, k = 0; i < 5; ++i) {
      const auto at = static_cast<std::size_t>(i);
      slope[i] = weight * now.slopes[at] - prior.precision[at] * (values[at] - prior.mean[at]);
      for (int j = 0; j <= i; ++j, ++k)
        curvature(i, j) = curvature(j, i) = weight * now.products[static_cast<std::size_t>(k)];
      curvature(i, i) += prior.precision[at] + 1e-9;
    }
    bool is_better = false;
    double saved = 0;
    while (!is_better && damping < 1e4) {
      Matrix5 damped = curvature;
      damped.diagonal() *= 1 + damping;
      const ShapedElement next = moved(element, damped.ldlt().solve(slope));
      const Slopes then = slopes_at(next, prior);
      is_better = then.cost < now.cost;
      damping *= is_better ? 0.2 : 10;
      if (!is_better) continue;
      saved = now.cost - then.cost;
      now = then;
      element = next;
    }
    if (saved < kEnoughGain) break;
  }
  const Matrix5 covariance = curvature.ldlt().solve(Matrix5::Identity());
  element.place_spread = std::sqrt(std::max(0.0, 0.5 * (covariance(0, 0) + covariance(1, 1))));
  element.log_scale_spread = std::sqrt(std::max(0.0, covariance(2, 2)));
  element.amplitude_spread = std::sqrt(std::max(0.0, covariance(3, 3)));
  return now.cost;
}

double ShapeFitter::try_one(ShapedElement& element, const ShapedPrior& prior) const {
  std::vector<std::pair<double, int>> order;
  for (std::size_t k = 0; k < shapes_->shapes.size(); ++k) {
    ShapedElement one = element;
    one.shape = static_cast<int>(k);
    order.emplace_back(rough_cost(one, prior), one.shape);
  }
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), kMostTried));
  ShapedElement best = element;
  double least = 1e300;
  for (const auto& [start, shape] : order) {
    ShapedElement one = element;
    one.shape = shape;
    const double now = solve(one, prior, kMostSteps);
    if (now >= least) continue;
    least = now;
    best = one;
  }
  element = best;
  return -least;
}

void ShapeFitter::unsettle_near(const ShapedElement& element) {
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const double reach = 0.8 * ShapeGrid::kReach * (std::exp(elements_[k].log_scale) + std::exp(element.log_scale));
    if (std::hypot(elements_[k].x - element.x, elements_[k].y - element.y) < reach) is_settled_[k] = 0;
  }
}

void ShapeFitter::add(const ShapedElement& element, const ShapedPrior& prior) {
  unsettle_near(element);
  elements_.push_back(element);
  priors_.push_back(prior);
  is_settled_.push_back(0);
  paint(element, 1);
}

void ShapeFitter::remove(std::size_t idx) {
  paint(elements_[idx], -1);
  const ShapedElement gone = elements_[idx];
  const auto place = static_cast<std::ptrdiff_t>(idx);
  elements_.erase(elements_.begin() + place);
  priors_.erase(priors_.begin() + place);
  is_settled_.erase(is_settled_.begin() + place);
  unsettle_near(gone);
}

void ShapeFitter::fit(int num_sweeps) {
  for (int sweep = 0; sweep < num_sweeps; ++sweep) {
    bool has_moved = false;
    for (std::size_t k = 0; k < elements_.size(); ++k) {
      if (is_settled_[k] != 0) continue;
      const ShapedElement before = elements_[k];
      paint(before, -1);
      ShapedElement after = before;
      try_one(after, priors_[k]);
      elements_[k] = after;
      paint(after, 1);
      const double scale = std::exp(before.log_scale);
      const bool moves = after.shape != before.shape ||
                         std::hypot(after.x - before.x, after.y - before.y) > kSettled * scale ||
                         std::abs(after.amplitude - before.amplitude) > 0.05 * std::abs(before.amplitude);
      if (moves) unsettle_near(after);
      has_moved = has_moved || moves;
      is_settled_[k] = 1;
    }
    if (!has_moved) break;
  }
}

double ShapeFitter::gain(std::size_t idx) const {
  // Without it the residual is left + element: −cost of adding it there.
  const ShapedElement& e = elements_[idx];
  double sum = 0;
  for_each_pixel(e, [&](int x, int y, double, double, const ShapeGrid::Point& p) {
    const double value = e.amplitude * static_cast<double>(p.value);
    sum += value * (value + 2 * static_cast<double>(left_.at(x, y)));
  });
  return sum / (noise_ * noise_);
}

double ShapeFitter::energy(std::size_t idx) const {
  const ShapedElement& e = elements_[idx];
  double sum = 0;
  for_each_pixel(e, [&](int, int, double, double, const ShapeGrid::Point& p) {
    sum += static_cast<double>(p.value) * static_cast<double>(p.value);
  });
  return sum * e.amplitude * e.amplitude / (noise_ * noise_);
}

double ShapeFitter::error() const {
  double sum = 0;
  for (const float value : left_.values) sum += static_cast<double>(value) * static_cast<double>(value);
  return sum / (noise_ * noise_);
}

ShapeFitter::UnderOne ShapeFitter::look_under(const ShapedElement& e) const {
  UnderOne out;
  for_each_pixel(e, [&](int x, int y, double, double, const ShapeGrid::Point& p) {
    const auto s = static_cast<double>(p.value);
    if (s < kUnder) return;
    const double value = e.amplitude * s, rest = static_cast<double>(left_.at(x, y));
    out.light += (value + rest) * (value + rest);
    out.left += rest * rest;
    out.num += 1;
  });
  return out;
}

double ShapeFitter::agreement(std::size_t idx) const {
  const UnderOne under = look_under(elements_[idx]);
  return under.light > 0 ? 1 - under.left / under.light : 0;
}

double ShapeFitter::misfit(std::size_t idx) const {
  const UnderOne under = look_under(elements_[idx]);
  return under.num > 0 ? under.left / under.num : 0;
}

}  // namespace motex
