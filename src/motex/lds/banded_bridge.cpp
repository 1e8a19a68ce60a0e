// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/lds/banded_bridge.h"

#include <Eigen/Cholesky>

#include "motex/core/error.h"

namespace motex {

BandedBridge::BandedBridge(const Lds& lds) : d_(lds.state_size()) {
  const Matrix w = whitening(lds);
  g0_ = w.leftCols(d_), g1_ = w.middleCols(d_, d_), g2_ = w.middleCols(2 * d_, d_);
  offset_ = -w.col(3 * d_);
  h0_ = g0_.transpose() * g0_ + g1_.transpose() * g1_ + g2_.transpose() * g2_;
  h1_ = g0_.transpose() * g1_ + g1_.transpose() * g2_;
  h2_ = g0_.transpose() * g2_;
}

void BandedBridge::append_block() {
  const std::size_t k = blocks_.size();
  Block b;
  Matrix diagonal = h0_;
  if (k >= 2) {
    b.below2.noalias() = h2_ * blocks_[k - 2].lower_inverse.transpose();
    diagonal.noalias() -= b.below2 * b.below2.transpose();
  }
  if (k >= 1) {
    Matrix rest = h1_;
    if (k >= 2) rest.noalias() -= b.below2 * blocks_[k - 1].below1.transpose();
    b.below1.noalias() = rest * blocks_[k - 1].lower_inverse.transpose();
    diagonal.noalias() -= b.below1 * b.below1.transpose();
  }
  const Eigen::LLT<Matrix> llt(diagonal);
  if (llt.info() != Eigen::Success)
    throw NumericalFailure("a texton cannot be synthesized: its normal equations are singular");
  b.lower_inverse = Matrix::Identity(d_, d_);
  llt.matrixL().solveInPlace(b.lower_inverse);
  blocks_.push_back(std::move(b));
}

void BandedBridge::solve(Eigen::Ref<FrameMatrix> states, const Eigen::Ref<const FrameMatrix>& noise) {
  const Index l = states.rows(), m = l - 4;
  if (m < 0 || states.cols() != d_ || noise.rows() != l - 2 || noise.cols() != d_)
    throw InvalidInput("BandedBridge::solve: a path needs at least 4 states, and noise for all but its first two");
  if (m == 0) return;
  while (static_cast<Index>(blocks_.size()) < m) append_block();
  // Equation e (e = 0 … l − 3) predicts row e + 2; what is known of it goes to the right.
  residuals_.resize(d_, l - 2);
  for (Index e = 0; e < l - 2; ++e) {
    auto r = residuals_.col(e);
    r = offset_ + noise.row(e).transpose();
    if (e < 1) r -= g1_ * states.row(1).transpose();
    if (e < 2) r -= g2_ * states.row(e).transpose();
    if (e >= m) r -= g0_ * states.row(e + 2).transpose();
    if (e > m) r -= g1_ * states.row(e + 1).transpose();
  }
  swept_.resize(d_, m);
  Vector rhs(d_);
  for (Index k = 0; k < m; ++k) {
    const Block& b = blocks_[static_cast<std::size_t>(k)];
    rhs.noalias() = g0_.transpose() * residuals_.col(k);
    rhs.noalias() += g1_.transpose() * residuals_.col(k + 1);
    rhs.noalias() += g2_.transpose() * residuals_.col(k + 2);
    if (k >= 1) rhs.noalias() -= b.below1 * swept_.col(k - 1);
    if (k >= 2) rhs.noalias() -= b.below2 * swept_.col(k - 2);
    swept_.col(k).noalias() = b.lower_inverse * rhs;
  }
  for (Index k = m - 1; k >= 0; --k) {
    rhs = swept_.col(k);
    if (k + 1 < m)
      rhs.noalias() -= blocks_[static_cast<std::size_t>(k + 1)].below1.transpose() * states.row(k + 3).transpose();
    if (k + 2 < m)
      rhs.noalias() -= blocks_[static_cast<std::size_t>(k + 2)].below2.transpose() * states.row(k + 4).transpose();
    states.row(k + 2).transpose().noalias() = blocks_[static_cast<std::size_t>(k)].lower_inverse.transpose() * rhs;
  }
}

}  // namespace motex
