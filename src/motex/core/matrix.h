// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace motex {

using Index = Eigen::Index;
using Vector = Eigen::VectorXd;
/// Parameters and covariances (column-major).
using Matrix = Eigen::MatrixXd;
/// Series: rows = frames, columns = channels, a frame contiguous in memory.
using FrameMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using FrameMatrixF = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace motex
