// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/joint_fit.h"

#include <algorithm>
#include <numeric>

namespace motex {
namespace {

constexpr int kMaxSteps = 60;
constexpr std::size_t kPixelsPerPair = 8;  // that cost as much: painted and measured in place of one inner product

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

JointFit::JointFit(const std::vector<Base>& bases, int width, int height, double ridge) : ridge_(ridge) {
  patches_.reserve(bases.size());
  std::size_t num_pixels = 0;
  for (const Base& base : bases) {
    patches_.push_back(render_patch(base, width, height));
    num_pixels += patches_.back().values.size();
  }
  const std::size_t most = num_pixels / kPixelsPerPair;
  const std::vector<Pair> pairs = overlapping(most);
  if (pairs.size() > most)
    painted_.emplace(patches_);
  else
    keep_products(pairs);
}

/// Pairs whose boxes have pixels in common; no more than one above `most`.
std::vector<JointFit::Pair> JointFit::overlapping(std::size_t most) const {
  std::vector<int> by_left(patches_.size());
  std::iota(by_left.begin(), by_left.end(), 0);
  const auto patch = [&](int j) -> const BasePatch& { return patches_[static_cast<std::size_t>(j)]; };
  std::stable_sort(by_left.begin(), by_left.end(), [&](int a, int b) { return patch(a).left < patch(b).left; });
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < by_left.size(); ++i) {
    const BasePatch& a = patch(by_left[i]);
    for (std::size_t k = i + 1; k < by_left.size() && patch(by_left[k]).left < a.left + a.width; ++k) {
      const BasePatch& b = patch(by_left[k]);
      if (b.top >= a.top + a.height || a.top >= b.top + b.height) continue;
      pairs.push_back({by_left[i], by_left[k]});
      if (pairs.size() > most) return pairs;
    }
  }
  return pairs;
}

void JointFit::keep_products(const std::vector<Pair>& pairs) {
  std::vector<std::vector<Overlap>> rows(patches_.size());
  for (const Pair& pair : pairs) {
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    rows[a].push_back({pair.b, inner_product(patches_[a], patches_[b])});
  }
  row_begin_.push_back(0);
  for (std::size_t j = 0; j < rows.size(); ++j) {
    overlaps_.insert(overlaps_.end(), rows[j].begin(), rows[j].end());
    row_begin_.push_back(overlaps_.size());
    energies_.push_back(energy_of(patches_[j]));
  }
}

void JointFit::multiply(const std::vector<double>& in, std::vector<double>& out, std::vector<float>& canvas) const {
  if (painted_) {
    painted_->multiply(in, out, canvas);
    for (std::size_t j = 0; j < in.size(); ++j) out[j] += ridge_ * in[j];
    return;
  }
  for (std::size_t j = 0; j < in.size(); ++j) out[j] = (energies_[j] + ridge_) * in[j];
  for (std::size_t j = 0; j < in.size(); ++j)
    for (std::size_t k = row_begin_[j]; k < row_begin_[j + 1]; ++k) {
      const auto other = static_cast<std::size_t>(overlaps_[k].other);
      out[j] += overlaps_[k].product * in[other];
      out[other] += overlaps_[k].product * in[j];
    }
}

std::vector<float> JointFit::solve(const Plane& target, const std::vector<float>& start) const {
  const std::size_t num = patches_.size();
  std::vector<float> canvas;
  std::vector<double> alpha(start.begin(), start.end()), slope(num), direction, product(num);
  multiply(alpha, product, canvas);
  for (std::size_t j = 0; j < num; ++j)
    slope[j] = static_cast<double>(inner_product(patches_[j], target)) + ridge_ * alpha[j] - product[j];
  direction = slope;
  double energy = dot(slope, slope);
  const double enough = 1e-6 * energy;
  for (int step = 0; step < kMaxSteps && energy > enough && energy > 1e-12; ++step) {
    multiply(direction, product, canvas);
    const double curvature = dot(direction, product);
    if (curvature <= 0) break;
    const double length = energy / curvature;
    for (std::size_t j = 0; j < num; ++j) {
      alpha[j] += length * direction[j];
      slope[j] -= length * product[j];
    }
    const double next = dot(slope, slope);
    for (std::size_t j = 0; j < num; ++j) direction[j] = slope[j] + next / energy * direction[j];
    energy = next;
  }
  return {alpha.begin(), alpha.end()};
}

}  // namespace motex
