// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/lds/bridge.h"

#include "motex/core/error.h"
#include "motex/core/gemm.h"

namespace motex {
namespace {

constexpr double kLeastRcond = 1e-8;

/// a · b or a · bᵀ (column-major square matrices; BLAS sees their transposes).
Matrix product(const Matrix& a, const Matrix& b, bool transpose_b = false) {
  const Index n = a.rows();
  Matrix c(n, n);
  gemm(transpose_b, false, n, n, n, 1.0, b.data(), n, a.data(), n, 0.0, c.data(), n);
  return c;
}

}  // namespace

Bridge::Bridge(const Lds& lds) : lds_(lds), d_(lds.state_size()), noise_chol_(lds.noise_chol) {
  const auto b = noise_chol_.triangularView<Eigen::Lower>();
  a1_ = b.solve(lds.transition.leftCols(d_) * noise_chol_);
  a2_ = b.solve(lds.transition.rightCols(d_) * noise_chol_);
  offset_ = b.solve(lds.offset);
  Steps one{Matrix::Zero(2 * d_, 2 * d_), Matrix::Zero(2 * d_, 2 * d_)};
  one.power.topLeftCorner(d_, d_) = a1_;
  one.power.topRightCorner(d_, d_) = a2_;
  one.power.bottomLeftCorner(d_, d_).setIdentity();
  one.gramian.topLeftCorner(d_, d_).setIdentity();
  doubled_.push_back(std::move(one));
}

/// The steps of a after those of b: P = P_a + Φᵃ P_b Φᵃᵀ.
Bridge::Steps Bridge::join(const Steps& a, const Steps& b) const {
  return {product(a.power, b.power), a.gramian + product(product(a.power, b.gramian), a.power, true)};
}

const Eigen::LLT<Matrix>* Bridge::factor(Index num_steps) {
  const auto trusted = [](const Eigen::LLT<Matrix>& llt) {
    return llt.info() == Eigen::Success && llt.rcond() > kLeastRcond;
  };
  const auto found = factors_.find(num_steps);
  if (found != factors_.end()) return trusted(found->second) ? &found->second : nullptr;
  Steps sum;
  bool any = false;
  for (std::size_t bit = 0; (num_steps >> bit) != 0; ++bit) {
    if (bit == doubled_.size()) doubled_.push_back(join(doubled_.back(), doubled_.back()));
    if (((num_steps >> bit) & 1) == 0) continue;
    sum = any ? join(doubled_[bit], sum) : doubled_[bit];
    any = true;
  }
  if (factors_.size() >= kMostFactors) factors_.clear();
  const auto& llt = factors_.emplace(num_steps, sum.gramian).first->second;
  return trusted(llt) ? &llt : nullptr;
}

/// Columns 2 … of z_ by the dynamics.
void Bridge::run(Index num_steps, const Eigen::Ref<const FrameMatrix>& noise, bool add_multipliers) {
  for (Index t = 2; t < num_steps + 2; ++t) {
    auto z = z_.col(t);
    z = offset_ + noise.row(t - 2).transpose();
    z.noalias() += a1_ * z_.col(t - 1);
    z.noalias() += a2_ * z_.col(t - 2);
    if (add_multipliers) z += multipliers_.col(t).head(d_);
  }
}

void Bridge::solve(Eigen::Ref<FrameMatrix> states, const Eigen::Ref<const FrameMatrix>& noise) {
  const Index l = states.rows(), n = l - 2;
  if (l < 4 || states.cols() != d_ || noise.rows() != n || noise.cols() != d_)
    throw InvalidInput("Bridge::solve: a path needs at least 4 states, and noise for all but its first two");
  if (l == 4) return;
  const auto* llt = banded_ ? nullptr : factor(n);
  if (llt == nullptr) {
    if (!banded_) banded_.emplace(lds_);
    banded_->solve(states, noise);
    return;
  }
  const auto b = noise_chol_.triangularView<Eigen::Lower>();
  z_.resize(d_, l);
  multipliers_.resize(2 * d_, l);
  z_.col(0) = b.solve(states.row(0).transpose());
  z_.col(1) = b.solve(states.row(1).transpose());
  run(n, noise, false);
  auto end = multipliers_.col(l - 1);
  end.head(d_) = b.solve(states.row(l - 1).transpose()) - z_.col(l - 1);
  end.tail(d_) = b.solve(states.row(l - 2).transpose()) - z_.col(l - 2);
  llt->solveInPlace(end);
  for (Index t = l - 1; t > 2; --t) {
    const auto now = multipliers_.col(t);
    auto before = multipliers_.col(t - 1);
    before.head(d_) = now.tail(d_);
    before.head(d_).noalias() += a1_.transpose() * now.head(d_);
    before.tail(d_).noalias() = a2_.transpose() * now.head(d_);
  }
  run(n, noise, true);
  for (Index t = 2; t < l - 2; ++t) states.row(t).transpose().noalias() = b * z_.col(t);
}

}  // namespace motex
