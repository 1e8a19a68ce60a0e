// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/lds/pinned_path.h"

#include <Eigen/SparseCholesky>

#include "motex/core/error.h"

namespace motex {
namespace {

/// Σ |W [x_t; x_{t−1}; x_{t−2}; 1]|² over t ≥ 2.
double noise_energy(const Matrix& w, const Eigen::Ref<const FrameMatrix>& x) {
  const Index d = x.cols(), n = x.rows() - 2;
  FrameMatrix r = x.bottomRows(n) * w.leftCols(d).transpose();
  r += x.middleRows(1, n) * w.middleCols(d, d).transpose();
  r += x.topRows(n) * w.middleCols(2 * d, d).transpose();
  r.rowwise() += w.col(3 * d).transpose();
  return r.squaredNorm();
}

}  // namespace

double least_noise_path(const Lds& lds, const std::vector<bool>& pinned, Eigen::Ref<FrameMatrix> states) {
  const Index l = states.rows(), d = lds.state_size();
  if (l < 3 || states.cols() != d || std::ssize(pinned) != l || !pinned[0] || !pinned[1])
    throw InvalidInput("least_noise_path: at least 3 states, of which the two first are pinned");
  const Matrix w = whitening(lds);
  std::vector<Index> place(static_cast<std::size_t>(l), -1);  // of a free row among the unknowns
  Index unknowns = 0;
  for (Index t = 0; t < l; ++t) {
    if (pinned[static_cast<std::size_t>(t)]) continue;
    place[static_cast<std::size_t>(t)] = unknowns;
    unknowns += d;
    states.row(t).setZero();
  }
  if (unknowns == 0) return noise_energy(w, states);
  std::vector<Eigen::Triplet<double>> entries;
  Vector rhs = Vector::Zero(unknowns);
  for (Index t = 2; t < l; ++t) {
    Vector known = w.col(3 * d);
    for (Index lag = 0; lag < 3; ++lag) known += w.middleCols(lag * d, d) * states.row(t - lag).transpose();
    for (Index a = 0; a < 3; ++a) {
      const Index row = place[static_cast<std::size_t>(t - a)];
      if (row < 0) continue;
      rhs.segment(row, d) -= w.middleCols(a * d, d).transpose() * known;
      for (Index b = 0; b < 3; ++b) {
        const Index column = place[static_cast<std::size_t>(t - b)];
        if (column < 0) continue;
        const Matrix block = w.middleCols(a * d, d).transpose() * w.middleCols(b * d, d);
        for (Index i = 0; i < d; ++i)
          for (Index j = 0; j < d; ++j)
            entries.emplace_back(static_cast<int>(row + i), static_cast<int>(column + j), block(i, j));
      }
    }
  }
  Eigen::SparseMatrix<double> normal(unknowns, unknowns);
  normal.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(normal);
  const Vector solution = factor.info() == Eigen::Success ? Vector(factor.solve(rhs)) : Vector();
  if (solution.size() == 0 || !solution.allFinite())
    throw NumericalFailure("a path through the given states cannot be found: its equations are singular");
  for (Index t = 0; t < l; ++t) {
    const Index row = place[static_cast<std::size_t>(t)];
    if (row >= 0) states.row(t) = solution.segment(row, d).transpose();
  }
  return noise_energy(w, states);
}

}  // namespace motex
