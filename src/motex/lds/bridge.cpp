// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/lds/bridge.h"

#include <Eigen/Cholesky>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr double kConverged = 1e-9;

}  // namespace

Bridge::Bridge(const Lds& lds)
    : d_(lds.state_size()), transition_(lds.transition), noise_chol_(lds.noise_chol), offset_(lds.offset) {
  const Matrix w = whitening(lds);
  g0_ = w.leftCols(d_), g1_ = w.middleCols(d_, d_), g2_ = w.middleCols(2 * d_, d_);
  h0_ = g0_.transpose() * g0_ + g1_.transpose() * g1_ + g2_.transpose() * g2_;
  h1_ = g0_.transpose() * g1_ + g1_.transpose() * g2_;
  h2_ = g0_.transpose() * g2_;
}

const Bridge::Block& Bridge::block(Index k) {
  while (!converged_ && num_blocks() <= k + 2) append_block();
  return blocks_[static_cast<std::size_t>(std::min(k, num_blocks() - 1))];
}

void Bridge::append_block() {
  const Index k = num_blocks();
  const auto prev = [&](Index back) -> Block& { return blocks_[static_cast<std::size_t>(k - back)]; };
  Block b;
  Matrix diagonal = h0_;
  b.below1 = Matrix::Zero(d_, d_);
  b.below2 = Matrix::Zero(d_, d_);
  if (k >= 2) b.below2.noalias() = h2_ * prev(2).lower_inverse.transpose();
  if (k >= 1) {
    Matrix rest = h1_;
    if (k >= 2) rest.noalias() -= b.below2 * prev(1).below1.transpose();
    b.below1.noalias() = rest * prev(1).lower_inverse.transpose();
    diagonal.noalias() -= b.below1 * b.below1.transpose();
  }
  if (k >= 2) diagonal.noalias() -= b.below2 * b.below2.transpose();
  const Eigen::LLT<Matrix> llt(diagonal);
  if (llt.info() != Eigen::Success) throw NumericalFailure("a texton cannot be synthesized: its normal equations are singular");
  b.lower_inverse = Matrix::Identity(d_, d_);
  llt.matrixL().solveInPlace(b.lower_inverse);
  if (k >= 1) prev(1).back1.noalias() = prev(1).lower_inverse.transpose() * b.below1.transpose();
  if (k >= 2) prev(2).back2.noalias() = prev(2).lower_inverse.transpose() * b.below2.transpose();
  blocks_.push_back(std::move(b));
  if (k < 5) return;
  const Block &now = blocks_.back(), &before = prev(1);
  if ((now.lower_inverse - before.lower_inverse).norm() < kConverged * now.lower_inverse.norm() &&
      (now.below1 - before.below1).norm() < kConverged * now.below1.norm()) {
    // The blocks that would complete the last ones are, to this precision, the ones before.
    blocks_.back().back1 = prev(2).back1;
    prev(1).back2 = prev(3).back2;
    blocks_.back().back2 = prev(3).back2;
    prev(1).back1 = prev(2).back1;
    converged_ = true;
  }
}

void Bridge::solve(Eigen::Ref<FrameMatrix> states, const Eigen::Ref<const FrameMatrix>& noise) {
  const Index l = states.rows(), m = l - 4;
  if (m < 0 || states.cols() != d_ || noise.rows() != l - 2 || noise.cols() != d_)
    throw InvalidInput("Bridge::solve: a path needs at least 4 states, and noise for all but its first two");
  if (m == 0) return;
  const auto step = [&](Index t) {  // x_t of the free run
    x_.noalias() = transition_.leftCols(d_) * states.row(t - 1).transpose();
    x_.noalias() += transition_.rightCols(d_) * states.row(t - 2).transpose();
    x_ += offset_;
    x_.noalias() += noise_chol_.triangularView<Eigen::Lower>() * noise.row(t - 2).transpose();
  };
  for (Index t = 2; t < l - 2; ++t) {
    step(t);
    states.row(t) = x_.transpose();
  }
  // Whitened residuals of the two last equations; all others are zero.
  step(l - 2);
  r0_ = g0_ * (states.row(l - 2).transpose() - x_);
  step(l - 1);
  r1_ = g0_ * (states.row(l - 1).transpose() - x_);
  // H δ = b with b in the two last blocks only.
  const Block& last = block(m - 1);
  y1_ = -g1_.transpose() * r0_ - g2_.transpose() * r1_;
  if (m >= 2) {
    y0_ = block(m - 2).lower_inverse * (-g2_.transpose() * r0_);
    y1_ -= block(m - 1).below1 * y0_;
  }
  y1_ = last.lower_inverse * y1_;
  Vector& next1 = r0_;  // δ_{k+1}
  Vector& next2 = r1_;  // δ_{k+2}
  next1.noalias() = block(m - 1).lower_inverse.transpose() * y1_;
  next2.setZero();
  states.row(m + 1) += next1.transpose();
  for (Index k = m - 2; k >= 0; --k) {
    const Block& b = block(k);
    x_.setZero();
    if (k == m - 2) x_.noalias() = b.lower_inverse.transpose() * y0_;
    x_.noalias() -= b.back1 * next1;
    if (k < m - 2) x_.noalias() -= b.back2 * next2;
    next2 = next1;
    next1 = x_;
    states.row(k + 2) += x_.transpose();
  }
}

}  // namespace motex
