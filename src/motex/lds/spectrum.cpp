// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <Eigen/Eigenvalues>

#include "motex/lds/lds.h"

namespace motex {

double spectral_radius(const Lds& lds) {
  const Index d = lds.state_size();
  Matrix companion = Matrix::Zero(2 * d, 2 * d);
  companion.topRows(d) = lds.transition;
  companion.bottomLeftCorner(d, d).setIdentity();
  return Eigen::EigenSolver<Matrix>(companion, false).eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace motex
