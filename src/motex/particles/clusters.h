// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/core/matrix.h"

namespace motex {

/// Directions in which points differ most: row i of the coordinates is (point i − mean) · axes.
struct PrincipalAxes {
  Eigen::VectorXd mean;
  Matrix axes;          ///< dimensions × num, orthonormal columns, by falling variance
  double variance = 0;  ///< mean squared distance from the mean, all dimensions
};
/// The axes that hold `share` of the variance, min_num … max_num of them. points: one a row.
PrincipalAxes principal_axes(const Matrix& points, double share, int min_num, int max_num);
Matrix coordinates(const Matrix& points, const PrincipalAxes& axes);

struct ChooseClustersOptions {
  int max_clusters = 8;
  double min_silhouette = 0.45;  ///< below: it is one cloud
  double min_distance = 0;       ///< squared, between centres
  double min_share = 0.03;       ///< of the points; smaller clusters are outliers and join the nearest large one
  int min_points = 3;
  std::uint64_t seed = 1;
};

/// Points in groups, and each group as a Gaussian with its own variance along each axis.
struct Clusters {
  std::vector<int> labels;  ///< one a point
  Matrix centres;           ///< clusters × dimensions
  Matrix variances;         ///< likewise, > 0
  Eigen::VectorXd shares;
  double silhouette = 0;  ///< mean; 0 for one cluster

  int num() const { return static_cast<int>(centres.rows()); }
};

/// As many clusters as the points show: that of k = 2 … max_clusters (k-means, L2) whose mean silhouette is
/// highest (by .05 over that of fewer), or one when none reaches min_silhouette with all centres min_distance apart.
/// Then expectation-maximisation of a mixture of Gaussians with diagonal covariances. Clusters by falling share. Cost:
/// a few ms a thousand points.
Clusters choose_clusters(const Matrix& points, const ChooseClustersOptions& options);

/// ln of (share ·) density of each cluster at a point, one column a cluster; one row a point.
Matrix cluster_log_densities(const Matrix& points, const Clusters& clusters, bool with_shares);

}  // namespace motex
