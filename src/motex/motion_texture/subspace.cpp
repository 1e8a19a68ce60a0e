// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/subspace.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "motex/core/error.h"
#include "motex/core/gemm.h"

namespace motex {

Subspace principal_subspace(const FrameMatrix& rows, Index state_size, double share, Index least, Index most) {
  const Index n = rows.rows(), dims = rows.cols();
  if (n < 2) throw InvalidInput("a subspace needs at least two frames");
  Subspace out;
  out.mean = rows.colwise().mean().transpose();
  const FrameMatrix centred = rows.rowwise() - out.mean.transpose();
  FrameMatrix covariance(dims, dims);
  gemm(true, false, dims, dims, n, 1.0 / static_cast<double>(n), centred.data(), dims, centred.data(), dims, 0.0,
       covariance.data(), dims);
  const Eigen::SelfAdjointEigenSolver<Matrix> solver{Matrix(covariance)};
  if (solver.info() != Eigen::Success) throw NumericalFailure("the principal directions of the frames were not found");
  const Vector variance = solver.eigenvalues().reverse().cwiseMax(0);
  Index size = state_size;
  if (size == 0) {
    double held = 0;
    while (size < dims && held < share * variance.sum()) held += variance[size++];
    size = std::clamp(size, least, most);
  }
  size = std::min({size, dims, std::max<Index>(n - 1, 1)});
  out.basis = solver.eigenvectors().rowwise().reverse().leftCols(size);
  // Signs are free: the largest coefficient is made positive, so that results do not hang on rounding.
  for (Index c = 0; c < size; ++c) {
    Index at;
    out.basis.col(c).cwiseAbs().maxCoeff(&at);
    if (out.basis(at, c) < 0) out.basis.col(c) *= -1;
  }
  return out;
}

FrameMatrix project(const Subspace& subspace, const Eigen::Ref<const FrameMatrix>& rows) {
  const FrameMatrix basis = subspace.basis;
  FrameMatrix out(rows.rows(), basis.cols());
  gemm(false, false, rows.rows(), basis.cols(), rows.cols(), 1.0, rows.data(), rows.outerStride(), basis.data(),
       basis.cols(), 0.0, out.data(), out.cols());
  out.rowwise() -= (subspace.mean.transpose() * subspace.basis).eval();
  return out;
}

}  // namespace motex
