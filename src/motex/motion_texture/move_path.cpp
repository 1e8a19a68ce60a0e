// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/move_path.h"

#include <algorithm>
#include <cmath>

#include "motex/core/gemm.h"
#include "motex/core/parallel.h"

namespace motex {
namespace {

constexpr Index kBlockFrames = 1024;
constexpr int kTabled = 256;

struct Moments {
  Vector mean, variance;
};

Moments moments_of(const FrameMatrix& states) {
  const auto count = static_cast<double>(std::max<Index>(states.rows(), 1));
  Moments moments;
  moments.mean = states.colwise().sum().transpose() / count;
  moments.variance = (states.rowwise() - moments.mean.transpose()).colwise().squaredNorm().transpose() / count;
  return moments;
}

/// θ with Σ_j min(θ, λ_j) = share · Σ_j λ_j.
double water_level(const Vector& variance, double share) {
  double low = 0, high = variance.maxCoeff();
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (variance.cwiseMin(middle).sum() < share * variance.sum() ? low : high) = middle;
  }
  return high;
}

}  // namespace

PathStatistics& PathStatistics::operator+=(const PathStatistics& other) {
  count += other.count;
  sum += other.sum;
  return *this;
}

MovePaths::MovePaths(const FrameMatrix& states, const std::vector<Run>& runs, Index min_frames, double weight)
    : weight_(weight), stride_(std::max<Index>(min_frames / kPoints, 1)), first_(stride_ / 2) {
  const Moments moments = moments_of(states);
  const double level = water_level(moments.variance, kShare);
  for (Index j = 0; j < states.cols(); ++j)
    if (moments.variance(j) > level * (1 + 1e-9)) channels_.push_back(j);
  mean_ = moments.mean(channels_);
  scale_ = Vector::Constant(mean_.size(), 1 / std::sqrt(level));
  ratio_ = (moments.variance(channels_) / level).replicate(kPoints, 1);
  inverse_ratio_ = ratio_.cwiseInverse();
  for (int n = 0; n < kTabled; ++n) log_terms_.push_back(log_of(n));
  own_ = windows(states, runs);
}

PathWindows MovePaths::windows(const FrameMatrix& states, const std::vector<Run>& runs) const {
  const auto p = static_cast<Index>(channels_.size());
  PathWindows out{FrameMatrixF::Zero(states.rows(), size()),
                  std::vector<bool>(static_cast<std::size_t>(states.rows()), false)};
  for (const Run& run : runs)
    for (Index row = run.row; row + first_ + (kPoints - 1) * stride_ < run.row + run.length; ++row) {
      out.is_whole[static_cast<std::size_t>(row)] = true;
      for (Index k = 0; k < kPoints; ++k) {
        const Vector state = states.row(row + first_ + k * stride_).transpose()(channels_);
        out.values.row(row).segment(k * p, p) = (state - mean_).cwiseProduct(scale_).transpose().cast<float>();
      }
    }
  return out;
}

PathStatistics MovePaths::observe(Index row) const {
  if (!own_.is_whole[static_cast<std::size_t>(row)]) return nothing();
  return {1, own_.values.row(row).transpose().cast<double>()};
}

double MovePaths::evidence(const PathStatistics& group) const {
  const auto n = static_cast<std::size_t>(group.count);
  const double log_term = n < log_terms_.size() ? log_terms_[n] : log_of(group.count);
  const auto precision = group.count + inverse_ratio_.array();
  return 0.5 * weight_ * ((group.sum.array().square() / precision).sum() - log_term);
}

double MovePaths::evidence(const PathStatistics& a, const PathStatistics& b) const {
  const auto n = static_cast<std::size_t>(a.count + b.count);
  const double log_term = n < log_terms_.size() ? log_terms_[n] : log_of(a.count + b.count);
  const auto precision = (a.count + b.count) + inverse_ratio_.array();
  return 0.5 * weight_ * (((a.sum + b.sum).array().square() / precision).sum() - log_term);
}

Vector MovePaths::path(const PathStatistics& group) const {
  return (group.sum.array() / (group.count + ratio_.array().inverse())).matrix();
}

double MovePaths::log_prior(const Vector& path) const {
  return -0.5 * weight_ * (path.array().square() / ratio_.array()).sum();
}

FrameMatrixF MovePaths::start_densities(const PathWindows& windows, const std::vector<Vector>& paths,
                                        const JobContext& job) const {
  const auto n = static_cast<Index>(paths.size());
  const Index frames = windows.values.rows(), p = size();
  FrameMatrixF rows(n, p), out(frames, n);
  Vector constants(n);
  const double log_ratio = 0.5 * ratio_.array().log().sum();
  for (Index i = 0; i < n; ++i) {
    const Vector& path = paths[static_cast<std::size_t>(i)];
    rows.row(i) = path.transpose().cast<float>();
    constants(i) = log_ratio - 0.5 * path.squaredNorm();
  }
  const Vector excess = 0.5 * (1 - ratio_.array().inverse()).matrix();  // of |z|² by I over that by R
  const auto blocks = static_cast<int>((frames + kBlockFrames - 1) / kBlockFrames);
  parallel_for(job.jobs, blocks, [&](int block) {
    job.check_cancelled();
    const Index first = block * kBlockFrames, count = std::min(kBlockFrames, frames - first);
    gemm(false, true, count, n, p, 1.0F, &windows.values(first, 0), p, rows.data(), p, 0.0F, &out(first, 0), n);
    for (Index t = first; t < first + count; ++t) {
      if (!windows.is_whole[static_cast<std::size_t>(t)]) {
        out.row(t).setZero();
        continue;
      }
      const double length = windows.values.row(t).cast<double>().array().square().matrix().dot(excess.transpose());
      out.row(t) =
          (weight_ * (out.row(t).cast<double>().array() + constants.transpose().array() - length)).cast<float>();
    }
  });
  return out;
}

}  // namespace motex
