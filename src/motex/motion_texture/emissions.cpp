// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/emissions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/gemm.h"
#include "motex/core/parallel.h"
#include "motex/motion_texture/subspace.h"

namespace motex {
namespace {

constexpr Index kBlockFrames = 192;
constexpr Index kTileRows = 480;

double log_2pi(Index dims, double deviation) {
  return static_cast<double>(dims) * std::log(2 * std::numbers::pi * deviation * deviation);
}

}  // namespace

EmissionBank::EmissionBank(const FrameMatrix& features, const std::vector<Run>& runs, const Subspace* shared,
                           double outside_deviation)
    : runs_(runs), is_shared_(shared != nullptr), deviation_(outside_deviation), num_features_(features.cols()) {
  const Index frames = features.rows();
  outside_.resize(static_cast<std::size_t>(frames));
  centre_ = is_shared_ ? shared->mean : Vector(features.colwise().mean().transpose());
  const Index m = is_shared_ ? shared->basis.cols() : num_features_;
  inputs_.resize(frames, m);
  const double scale = 0.5 / (deviation_ * deviation_);
  for (Index t = 0; t < frames; ++t) {
    const Vector y = features.row(t).transpose() - centre_;
    double& outside = outside_[static_cast<std::size_t>(t)];
    if (is_shared_) {
      const Vector x = shared->basis.transpose() * y;
      inputs_.row(t) = x.transpose().cast<float>();
      outside =
          -scale * std::max(0.0, y.squaredNorm() - x.squaredNorm()) - 0.5 * log_2pi(num_features_ - m, deviation_);
    } else {
      inputs_.row(t) = y.transpose().cast<float>();
      outside = y.squaredNorm();
    }
  }
}

void EmissionBank::set_texton(int texton, const Subspace& subspace, const Lds& dynamics) {
  if (texton >= num_textons()) rows_.resize(static_cast<std::size_t>(texton) + 1);
  Rows& rows = rows_[static_cast<std::size_t>(texton)];
  const Index d = dynamics.state_size(), m = inputs_.cols();
  const Matrix w = whitening(dynamics);
  Matrix residual(d, 3 * m + 1);
  residual.col(0) = w.col(3 * d);
  rows.constant = -0.5 * (static_cast<double>(d) * std::log(2 * std::numbers::pi) + dynamics.log_det);
  if (is_shared_) {
    residual.rightCols(3 * m) = w.leftCols(3 * d);
  } else {
    const Matrix basis = subspace.basis.transpose();
    const Vector shift = basis * (subspace.mean - centre_);  // x = basis · (input) − shift
    for (Index lag = 0; lag < 3; ++lag) {
      const Matrix part = w.middleCols(lag * d, d);
      residual.middleCols(1 + lag * m, m) = part * basis;
      residual.col(0) -= part * shift;
    }
    const Vector mean = subspace.mean - centre_;
    rows.outside.resize(d + 1, m + 1);
    rows.outside.topRows(d) << -shift.cast<float>(), basis.cast<float>();
    rows.outside.row(d) << static_cast<float>(mean.squaredNorm()), (-2 * mean).transpose().cast<float>();
    rows.constant -= 0.5 * log_2pi(num_features_ - d, deviation_);
  }
  rows.residual = residual.cast<float>();
}

void EmissionBank::evaluate(const std::vector<int>& textons, FrameMatrixF& out, const JobContext& job) const {
  struct Block {
    Index row, count;
  };
  std::vector<Block> blocks;
  for (const Run& run : runs_) {
    out.middleRows(run.row, 2).setZero();
    for (Index t = 2; t < run.length; t += kBlockFrames)
      blocks.push_back({run.row + t, std::min(kBlockFrames, run.length - t)});
  }
  parallel_for(job.jobs, static_cast<int>(blocks.size()), [&](int b) {
    job.check_cancelled();
    evaluate_block(textons, blocks[static_cast<std::size_t>(b)].row, blocks[static_cast<std::size_t>(b)].count, out);
  });
}

void EmissionBank::evaluate_block(const std::vector<int>& textons, Index row, Index count, FrameMatrixF& out) const {
  const Index m = inputs_.cols();
  FrameMatrixF u(count, 3 * m + 1);
  u.col(0).setOnes();
  for (Index lag = 0; lag < 3; ++lag) u.middleCols(1 + lag * m, m) = inputs_.middleRows(row - lag, count);
  FrameMatrixF stacked, stacked_outside, product, product_outside;
  const double scale = 0.5 / (deviation_ * deviation_);
  for (std::size_t first = 0; first < textons.size();) {
    Index num_rows = 0, num_outside = 0;
    std::size_t end = first;
    const auto at = [&](std::size_t i) -> const Rows& { return rows_[static_cast<std::size_t>(textons[i])]; };
    for (; end < textons.size() && (end == first || num_rows + at(end).residual.rows() <= kTileRows); ++end) {
      num_rows += at(end).residual.rows();
      num_outside += at(end).outside.rows();
    }
    stacked.resize(num_rows, 3 * m + 1);
    stacked_outside.resize(num_outside, m + 1);
    Index r = 0, o = 0;
    for (std::size_t i = first; i < end; ++i) {
      stacked.middleRows(r, at(i).residual.rows()) = at(i).residual;
      r += at(i).residual.rows();
      if (!is_shared_) stacked_outside.middleRows(o, at(i).outside.rows()) = at(i).outside;
      o += at(i).outside.rows();
    }
    product.resize(count, num_rows);
    gemm(false, true, count, num_rows, 3 * m + 1, 1.0F, u.data(), u.cols(), stacked.data(), stacked.cols(), 0.0F,
         product.data(), num_rows);
    if (!is_shared_) {
      product_outside.resize(count, num_outside);
      gemm(false, true, count, num_outside, m + 1, 1.0F, u.data(), u.cols(), stacked_outside.data(), m + 1, 0.0F,
           product_outside.data(), num_outside);
    }
    for (Index t = 0; t < count; ++t) {
      const float* values = &product(t, 0);
      const float* values_outside = is_shared_ ? nullptr : &product_outside(t, 0);
      const double outside = outside_[static_cast<std::size_t>(row + t)];
      for (std::size_t i = first; i < end; ++i) {
        const Index d = at(i).residual.rows();
        double sum = at(i).constant - 0.5 * Eigen::Map<const Eigen::VectorXf>(values, d).squaredNorm();
        values += d;
        if (is_shared_) {
          sum += outside;
        } else {
          const double inside = Eigen::Map<const Eigen::VectorXf>(values_outside, d).squaredNorm();
          sum -= scale * std::max(0.0, outside + static_cast<double>(values_outside[d]) - inside);
          values_outside += d + 1;
        }
        out(row + t, textons[i]) = static_cast<float>(sum);
      }
    }
    first = end;
  }
}

}  // namespace motex
