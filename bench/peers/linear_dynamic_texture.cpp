// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "bench/peers/linear_dynamic_texture.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace motex::peers {
namespace {

Vector stacked(const Planes& frame) {
  Vector out(static_cast<Index>(frame.size() * frame[0].values.size()));
  Index at = 0;
  for (const Plane& plane : frame)
    for (const float value : plane.values) out[at++] = static_cast<double>(value);
  return out;
}

Matrix square_root(const Matrix& covariance) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(covariance);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

}  // namespace

LinearDynamicTexture::LinearDynamicTexture(const std::vector<Planes>& frames, int rank) : mean_(frames.at(0)) {
  const auto num = static_cast<Index>(frames.size());
  const auto kept = std::min<Index>(rank, num - 2);
  Matrix data(stacked(frames[0]).size(), num);
  for (Index t = 0; t < num; ++t) data.col(t) = stacked(frames[static_cast<std::size_t>(t)]);
  const Vector mean = data.rowwise().mean();
  Index at = 0;
  for (Plane& plane : mean_)
    for (float& value : plane.values) value = static_cast<float>(mean[at++]);
  data.colwise() -= mean;
  const Eigen::SelfAdjointEigenSolver<Matrix> gram(data.transpose() * data);
  const Vector strengths = gram.eigenvalues().tail(kept).reverse().cwiseMax(1e-9).cwiseSqrt();
  const Matrix right = gram.eigenvectors().rightCols(kept).rowwise().reverse();
  images_ = data * right * strengths.cwiseInverse().asDiagonal();
  states_ = strengths.asDiagonal() * right.transpose();
  const Matrix before = states_.leftCols(num - 1), after = states_.rightCols(num - 1);
  const Matrix ridge = 1e-9 * states_.squaredNorm() * Matrix::Identity(kept, kept);
  transition_ = (before * before.transpose() + ridge).llt().solve(before * after.transpose()).transpose();
  const double radius = Eigen::EigenSolver<Matrix>(transition_, false).eigenvalues().cwiseAbs().maxCoeff();
  const Matrix left = after - transition_ * before;
  if (radius > 0.999) transition_ *= 0.999 / radius;
  noise_ = square_root(left * left.transpose() / static_cast<double>(num - 1));
  start(1);
}

double LinearDynamicTexture::num_numbers() const {
  return static_cast<double>(images_.size() + images_.rows() + transition_.size() + noise_.size());
}

Vector LinearDynamicTexture::state_of(const Planes& frame) const {
  return images_.transpose() * (stacked(frame) - stacked(mean_));
}

Planes LinearDynamicTexture::frame_of(const Vector& state) const {
  const Vector image = images_ * state;
  Planes out = mean_;
  Index at = 0;
  for (Plane& plane : out)
    for (float& value : plane.values) value = std::clamp(value + static_cast<float>(image[at++]), 0.0F, 255.0F);
  return out;
}

Planes LinearDynamicTexture::predict(const Planes& last) const { return frame_of(transition_ * state_of(last)); }

void LinearDynamicTexture::start(std::uint64_t seed) {
  rng_ = Rng(seed);
  state_ = states_.col(static_cast<Index>(rng_.below(static_cast<std::uint64_t>(states_.cols()))));
}

Planes LinearDynamicTexture::next() {
  Vector noise(state_.size());
  for (Index k = 0; k < noise.size(); ++k) noise[k] = rng_.normal();
  state_ = transition_ * state_ + noise_ * noise;
  return frame_of(state_);
}

}  // namespace motex::peers
