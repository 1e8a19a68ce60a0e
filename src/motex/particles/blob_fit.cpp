// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/blob_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "motex/particles/blob_cluster.h"
#include "motex/particles/blob_shape.h"

namespace motex {
namespace {

constexpr double kJointDistance = 2.5;  // mean scales: nearer blobs are fitted together
constexpr std::size_t kLargestCluster = 10;

double square(double value) { return value * value; }
double square_distance(const Blob& a, const Blob& b) { return square(a.x - b.x) + square(a.y - b.y); }

}  // namespace

BlobFitter::BlobFitter(const Plane& image, const FitBlobsOptions& options)
    : options_(options), residual_(image), cluster_(std::make_unique<BlobCluster>(residual_, options_)) {}
BlobFitter::~BlobFitter() = default;

void BlobFitter::add(const Blob& blob, const BlobPrior& prior) {
  unsettle_near(blob);
  blobs_.push_back(blob);
  priors_.push_back(prior);
  is_settled_.push_back(0);
  paint(blob, 1);
}

void BlobFitter::remove(std::size_t idx) {
  paint(blobs_[idx], -1);
  unsettle_near(blobs_[idx]);
  const auto place = static_cast<std::ptrdiff_t>(idx);
  blobs_.erase(blobs_.begin() + place);
  priors_.erase(priors_.begin() + place);
  is_settled_.erase(is_settled_.begin() + place);
}

void BlobFitter::unsettle_near(const Blob& blob) {
  for (std::size_t k = 0; k < blobs_.size(); ++k)
    if (square_distance(blobs_[k], blob) < square(2 * (blobs_[k].scale() + blob.scale()))) is_settled_[k] = 0;
}

void BlobFitter::paint(const Blob& blob, float sign) {
  const PixelBox box = box_of(blob, residual_, 0);
  if (box.is_empty()) return;
  std::vector<float>& values = painted_;
  values.resize(box.area());
  fill_gaussian(blob, box, values.data());
  const float weight = sign * static_cast<float>(blob.amplitude);
  const float* value = values.data();
  for (int y = box.top; y < box.bottom; ++y) {
    float* row = residual_.row(y) + box.left;
    for (int x = 0; x < box.width(); ++x) row[x] -= weight * *value++;
  }
}

double BlobFitter::misfit(std::size_t idx) const {
  const Blob& blob = blobs_[idx];
  const BlobPrecision p = precision_of(blob.log_scale, blob.e1, blob.e2);
  const PixelBox box = box_of(blob, residual_, 0);
  double sum = 0;
  int num = 0;
  for (int y = box.top; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; ++x) {
      const double dx = x - blob.x, dy = y - blob.y;
      if (p.xx * dx * dx + 2 * p.xy * dx * dy + p.yy * dy * dy > 4) continue;
      sum += static_cast<double>(residual_.at(x, y)) * static_cast<double>(residual_.at(x, y));
      ++num;
    }
  return num > 0 ? sum / num : 0;
}

double BlobFitter::cost_near(const Blob& blob) const {
  const PixelBox box = box_of(blob, residual_, 2);
  double sum = 0;
  for (int y = box.top; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; ++x)
      sum += static_cast<double>(residual_.at(x, y)) * static_cast<double>(residual_.at(x, y));
  return sum / (options_.noise * options_.noise);
}

bool BlobFitter::split(std::size_t idx, double min_gain) {
  const Blob one = blobs_[idx];
  const PixelBox box = box_of(one, residual_, 0);
  // Second moments of what is left, weighted by the spot: two spots leave more along their line than across.
  double along = 0, diagonal = 0;
  for (int y = box.top; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; ++x) {
      const double dx = x - one.x, dy = y - one.y;
      const double weight = std::exp(-0.25 * (dx * dx + dy * dy) / (one.scale() * one.scale()));
      const double value = weight * static_cast<double>(residual_.at(x, y)) * (one.amplitude > 0 ? 1 : -1);
      along += value * (dx * dx - dy * dy);
      diagonal += value * 2 * dx * dy;
    }
  const double angle = 0.5 * std::atan2(diagonal, along), away = 0.7 * one.scale();
  const double before = cost_near(one);
  Blob a = one, b = one;
  a.x += away * std::cos(angle);
  a.y += away * std::sin(angle);
  b.x -= away * std::cos(angle);
  b.y -= away * std::sin(angle);
  for (Blob* half : {&a, &b}) {
    half->amplitude *= 0.65;
    half->log_scale -= 0.15;
  }
  paint(one, -1);
  blobs_[idx] = a;
  paint(a, 1);
  blobs_.push_back(b);
  priors_.emplace_back();
  is_settled_.push_back(0);
  paint(b, 1);
  fit_cluster({static_cast<int>(idx), static_cast<int>(blobs_.size()) - 1});
  if (before - cost_near(one) >= min_gain) {
    unsettle_near(one);
    return true;
  }
  paint(blobs_.back(), -1);
  blobs_.pop_back();
  priors_.pop_back();
  is_settled_.pop_back();
  paint(blobs_[idx], -1);
  blobs_[idx] = one;
  paint(one, 1);
  return false;
}

/// What fit() minimises, over the whole image.
double BlobFitter::cost() const {
  double energy = 0, priors = 0;
  for (const float value : residual_.values) energy += static_cast<double>(value) * static_cast<double>(value);
  for (std::size_t k = 0; k < blobs_.size(); ++k) {
    const Blob& b = blobs_[k];
    const std::array<double, 6> values{b.x, b.y, b.log_scale, b.e1, b.e2, b.amplitude};
    for (std::size_t i = 0; i < values.size(); ++i)
      priors += priors_[k].precision[i] * square(values[i] - priors_[k].mean[i]);
  }
  return energy / (options_.noise * options_.noise) + priors;
}

bool BlobFitter::add_beside(std::size_t idx, const std::vector<std::pair<Blob, BlobPrior>>& added, double max_loss) {
  const Plane residual = residual_;
  const std::vector<Blob> blobs = blobs_;
  const std::vector<BlobPrior> priors = priors_;
  const std::vector<char> is_settled = is_settled_;
  const double before = cost();
  priors_[idx] = {};
  for (const auto& [blob, prior] : added) add(blob, prior);
  fit(2);
  if (cost() < before + max_loss) return true;
  residual_ = residual;
  blobs_ = blobs;
  priors_ = priors;
  is_settled_ = is_settled;
  return false;
}

std::vector<std::vector<int>> BlobFitter::clusters() const {
  // Nearest pairs first, so that a cluster that grows too large keeps those that overlap most.
  struct Pair {
    double distance;
    int a, b;
  };
  std::vector<int> by_x(blobs_.size());
  std::iota(by_x.begin(), by_x.end(), 0);
  const auto blob = [&](int k) -> const Blob& { return blobs_[static_cast<std::size_t>(k)]; };
  std::sort(by_x.begin(), by_x.end(),
            [&](int a, int b) { return blob(a).x < blob(b).x || (blob(a).x == blob(b).x && a < b); });
  double largest = 0;
  for (const Blob& b : blobs_) largest = std::max(largest, b.scale());
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < by_x.size(); ++i)
    for (std::size_t j = i + 1; j < by_x.size(); ++j) {
      const Blob &a = blob(by_x[i]), &b = blob(by_x[j]);
      if (b.x - a.x > kJointDistance * largest) break;
      const double distance = square_distance(a, b) / square(0.5 * (a.scale() + b.scale()));
      if (distance < square(kJointDistance)) pairs.push_back({distance, by_x[i], by_x[j]});
    }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.distance, a.a, a.b) < std::tie(b.distance, b.a, b.b);
  });
  std::vector<std::vector<int>> groups(blobs_.size());
  std::vector<int> group_of(blobs_.size());
  for (std::size_t k = 0; k < blobs_.size(); ++k) {
    groups[k] = {static_cast<int>(k)};
    group_of[k] = static_cast<int>(k);
  }
  for (const Pair& pair : pairs) {
    const auto a = static_cast<std::size_t>(group_of[static_cast<std::size_t>(pair.a)]),
               b = static_cast<std::size_t>(group_of[static_cast<std::size_t>(pair.b)]);
    if (a == b || groups[a].size() + groups[b].size() > kLargestCluster) continue;
    for (const int k : groups[b]) group_of[static_cast<std::size_t>(k)] = static_cast<int>(a);
    groups[a].insert(groups[a].end(), groups[b].begin(), groups[b].end());
    groups[b].clear();
  }
  std::erase_if(groups, [](const std::vector<int>& group) { return group.empty(); });
  return groups;
}

bool BlobFitter::fit_cluster(const std::vector<int>& members) {
  for (const int k : members) paint(blobs_[static_cast<std::size_t>(k)], -1);
  cluster_->clear();
  for (const int k : members) cluster_->take(blobs_[static_cast<std::size_t>(k)], priors_[static_cast<std::size_t>(k)]);
  const bool has_moved = cluster_->solve();
  for (std::size_t k = 0; k < members.size(); ++k) blobs_[static_cast<std::size_t>(members[k])] = cluster_->blob(k);
  for (const int k : members) paint(blobs_[static_cast<std::size_t>(k)], 1);
  return has_moved;
}

void BlobFitter::fit(int num_sweeps) {
  for (int sweep = 0; sweep < num_sweeps; ++sweep) {
    bool is_done = true;
    for (const std::vector<int>& members : clusters()) {
      bool is_settled = true;
      for (const int k : members) is_settled = is_settled && is_settled_[static_cast<std::size_t>(k)] != 0;
      if (is_settled) continue;
      const bool has_moved = fit_cluster(members);
      if (has_moved)
        for (const int k : members) unsettle_near(blobs_[static_cast<std::size_t>(k)]);
      for (const int k : members) is_settled_[static_cast<std::size_t>(k)] = 1;
      is_done = is_done && !has_moved;
    }
    if (is_done) break;
  }
}

}  // namespace motex
