// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/clusters.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "motex/core/rng.h"

namespace motex {
namespace {

constexpr int kRestarts = 6, kMeansSteps = 40, kMixtureSteps = 60;
constexpr int kSilhouettePoints = 700;
constexpr double kLeastVariance = 2e-4;
constexpr double kWorthOneMore = 0.05;  // of silhouette

/// Labels and centres of one run from centres drawn by squared distance (k-means++).
struct KMeans {
  std::vector<int> labels;
  Matrix centres;
  double error = std::numeric_limits<double>::infinity();
};

int nearest(const Matrix& centres, const Eigen::Ref<const Eigen::RowVectorXd>& point, double* distance = nullptr) {
  Index best = 0;
  const double least = (centres.rowwise() - point).rowwise().squaredNorm().minCoeff(&best);
  if (distance != nullptr) *distance = least;
  return static_cast<int>(best);
}

Matrix spread_centres(const Matrix& points, int k, Rng& rng) {
  Matrix centres(k, points.cols());
  const auto num = static_cast<std::uint64_t>(points.rows());
  centres.row(0) = points.row(static_cast<Index>(rng.below(num)));
  std::vector<double> distances(num, std::numeric_limits<double>::infinity());
  for (int j = 1; j < k; ++j) {
    double sum = 0;
    for (Index i = 0; i < points.rows(); ++i) {
      double& distance = distances[static_cast<std::size_t>(i)];
      distance = std::min(distance, (points.row(i) - centres.row(j - 1)).squaredNorm());
      sum += distance;
    }
    const std::size_t next = sum > 0 ? rng.weighted(distances) : static_cast<std::size_t>(rng.below(num));
    centres.row(j) = points.row(static_cast<Index>(next));
  }
  return centres;
}

KMeans k_means_from(const Matrix& points, Matrix centres) {
  KMeans out{std::vector<int>(static_cast<std::size_t>(points.rows()), -1), std::move(centres), 0};
  for (int step = 0; step < kMeansSteps; ++step) {
    bool changed = false;
    out.error = 0;
    Matrix sums = Matrix::Zero(out.centres.rows(), points.cols());
    Eigen::VectorXd counts = Eigen::VectorXd::Zero(out.centres.rows());
    for (Index i = 0; i < points.rows(); ++i) {
      double distance = 0;
      const int label = nearest(out.centres, points.row(i), &distance);
      changed |= label != out.labels[static_cast<std::size_t>(i)];
      out.labels[static_cast<std::size_t>(i)] = label;
      out.error += distance;
      sums.row(label) += points.row(i);
      counts[label] += 1;
    }
    for (Index j = 0; j < counts.size(); ++j)
      if (counts[j] > 0) out.centres.row(j) = sums.row(j) / counts[j];
    if (!changed) break;
  }
  return out;
}

KMeans k_means(const Matrix& points, int k, Rng& rng) {
  KMeans best;
  for (int run = 0; run < kRestarts; ++run) {
    KMeans one = k_means_from(points, spread_centres(points, k, rng));
    if (one.error < best.error) best = std::move(one);
  }
  return best;
}

/// Clusters of few points are taken away; their points go to the nearest of the others.
KMeans without_outliers(const Matrix& points, KMeans found, const ChooseClustersOptions& options) {
  std::vector<Index> counts(static_cast<std::size_t>(found.centres.rows()), 0);
  for (const int label : found.labels) ++counts[static_cast<std::size_t>(label)];
  const double least = std::max<double>(options.min_points, options.min_share * static_cast<double>(points.rows()));
  std::vector<Index> kept;
  for (std::size_t j = 0; j < counts.size(); ++j)
    if (static_cast<double>(counts[j]) >= least) kept.push_back(static_cast<Index>(j));
  if (kept.size() == counts.size() || kept.empty()) return found;
  KMeans out{found.labels, Matrix(static_cast<Index>(kept.size()), points.cols()), found.error};
  for (std::size_t j = 0; j < kept.size(); ++j) out.centres.row(static_cast<Index>(j)) = found.centres.row(kept[j]);
  for (Index i = 0; i < points.rows(); ++i)
    out.labels[static_cast<std::size_t>(i)] = nearest(out.centres, points.row(i));
  return out;
}

/// Mean of (b − a)/max(a, b): a = mean distance within the point's cluster, b = to the nearest other one.
double silhouette_of(const Matrix& points, const std::vector<int>& labels, int k) {
  const Index stride = std::max<Index>(1, points.rows() / kSilhouettePoints);
  std::vector<Index> sample;
  for (Index i = 0; i < points.rows(); i += stride) sample.push_back(i);
  std::vector<double> counts(static_cast<std::size_t>(k), 0), sums(static_cast<std::size_t>(k));
  for (const Index i : sample) counts[static_cast<std::size_t>(labels[static_cast<std::size_t>(i)])] += 1;
  double total = 0;
  for (const Index i : sample) {
    std::fill(sums.begin(), sums.end(), 0);
    for (const Index m : sample)
      sums[static_cast<std::size_t>(labels[static_cast<std::size_t>(m)])] += (points.row(i) - points.row(m)).norm();
    const auto own = static_cast<std::size_t>(labels[static_cast<std::size_t>(i)]);
    double other = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < sums.size(); ++j)
      if (j != own && counts[j] > 0) other = std::min(other, sums[j] / counts[j]);
    if (counts[own] < 2 || !std::isfinite(other)) continue;
    const double within = sums[own] / (counts[own] - 1);
    total += (other - within) / std::max({other, within, 1e-12});
  }
  return sample.empty() ? 0 : total / static_cast<double>(sample.size());
}

double nearest_centres(const Matrix& centres) {
  double least = std::numeric_limits<double>::infinity();
  for (Index a = 0; a < centres.rows(); ++a)
    for (Index b = 0; b < a; ++b) least = std::min(least, (centres.row(a) - centres.row(b)).squaredNorm());
  return least;
}

/// exp and normalise each row.
Matrix responsibilities(const Matrix& log_densities) {
  Matrix out = log_densities.colwise() - log_densities.rowwise().maxCoeff();
  out = out.array().exp();
  return out.array().colwise() / out.rowwise().sum().array();
}

void update(Clusters& clusters, const Matrix& points, const Matrix& weights) {
  for (Index j = 0; j < weights.cols(); ++j) {
    const double sum = std::max(1e-9, weights.col(j).sum());
    clusters.shares[j] = sum / static_cast<double>(points.rows());
    clusters.centres.row(j) = weights.col(j).transpose() * points / sum;
    const Matrix away = points.rowwise() - clusters.centres.row(j);
    clusters.variances.row(j) = ((weights.col(j).transpose() * away.cwiseAbs2()) / sum).array() + kLeastVariance;
  }
}

void relabel(Clusters& clusters, const Matrix& points) {
  const Matrix scores = cluster_log_densities(points, clusters, true);
  for (Index i = 0; i < points.rows(); ++i) {
    Index best = 0;
    scores.row(i).maxCoeff(&best);
    clusters.labels[static_cast<std::size_t>(i)] = static_cast<int>(best);
  }
}

void sort_by_share(Clusters& clusters) {
  std::vector<Index> order(static_cast<std::size_t>(clusters.num()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return clusters.shares[a] > clusters.shares[b]; });
  const Clusters old = clusters;
  std::vector<int> place(order.size());
  for (std::size_t j = 0; j < order.size(); ++j) {
    const auto to = static_cast<Index>(j);
    clusters.centres.row(to) = old.centres.row(order[j]);
    clusters.variances.row(to) = old.variances.row(order[j]);
    clusters.shares[to] = old.shares[order[j]];
    place[static_cast<std::size_t>(order[j])] = static_cast<int>(j);
  }
  for (int& label : clusters.labels) label = place[static_cast<std::size_t>(label)];
}

Clusters mixture_from(const Matrix& points, const KMeans& start, double silhouette) {
  const Index k = start.centres.rows();
  Clusters out{start.labels, start.centres, Matrix::Constant(k, points.cols(), kLeastVariance),
               Eigen::VectorXd::Ones(k), silhouette};
  Matrix weights = Matrix::Zero(points.rows(), k);
  for (Index i = 0; i < points.rows(); ++i) weights(i, start.labels[static_cast<std::size_t>(i)]) = 1;
  update(out, points, weights);
  for (int step = 0; k > 1 && step < kMixtureSteps; ++step) {
    const Matrix next = responsibilities(cluster_log_densities(points, out, true));
    const double change = (next - weights).cwiseAbs().maxCoeff();
    weights = next;
    update(out, points, weights);
    if (change < 1e-3) break;
  }
  relabel(out, points);
  sort_by_share(out);
  return out;
}

}  // namespace

PrincipalAxes principal_axes(const Matrix& points, double share, int min_num, int max_num) {
  PrincipalAxes out;
  out.mean = points.colwise().mean().transpose();
  const Matrix centred = points.rowwise() - out.mean.transpose();
  const Matrix covariance = centred.transpose() * centred / static_cast<double>(std::max<Index>(1, points.rows()));
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(covariance);
  out.variance = covariance.trace();
  Index num = 0;
  double sum = 0;
  const Index most = std::min<Index>(max_num, points.cols());
  while (num < most && (num < min_num || sum < share * out.variance)) {
    sum += solver.eigenvalues()[points.cols() - 1 - num];
    ++num;
  }
  out.axes = solver.eigenvectors().rightCols(num).rowwise().reverse();
  for (Index j = 0; j < num; ++j) {  // a sign that does not depend on the solver
    Index largest = 0;
    out.axes.col(j).cwiseAbs().maxCoeff(&largest);
    if (out.axes(largest, j) < 0) out.axes.col(j) *= -1;
  }
  return out;
}

Matrix coordinates(const Matrix& points, const PrincipalAxes& axes) {
  return (points.rowwise() - axes.mean.transpose()) * axes.axes;
}

Matrix cluster_log_densities(const Matrix& points, const Clusters& clusters, bool with_shares) {
  Matrix out(points.rows(), clusters.num());
  for (Index j = 0; j < out.cols(); ++j) {
    const Eigen::RowVectorXd inverse = clusters.variances.row(j).cwiseInverse();
    const double constant = -0.5 * (clusters.variances.row(j).array() * 2 * 3.14159265358979).log().sum() +
                            (with_shares ? std::log(std::max(1e-12, clusters.shares[j])) : 0);
    out.col(j) =
        (-0.5 * ((points.rowwise() - clusters.centres.row(j)).cwiseAbs2() * inverse.transpose())).array() + constant;
  }
  return out;
}

Clusters choose_clusters(const Matrix& points, const ChooseClustersOptions& options) {
  Rng rng(options.seed);
  KMeans best{std::vector<int>(static_cast<std::size_t>(points.rows()), 0), points.colwise().mean(), 0};
  double best_silhouette = 0;
  for (int k = 2; k <= options.max_clusters && points.rows() >= static_cast<Index>(k) * options.min_points; ++k) {
    KMeans found = without_outliers(points, k_means(points, k, rng), options);
    const auto num = static_cast<int>(found.centres.rows());
    if (num < 2 || nearest_centres(found.centres) < options.min_distance) continue;
    const double silhouette = silhouette_of(points, found.labels, num);
    if (silhouette < options.min_silhouette || (best_silhouette > 0 && silhouette < best_silhouette + kWorthOneMore))
      continue;
    best = std::move(found);
    best_silhouette = silhouette;
  }
  return mixture_from(points, best, best_silhouette);
}

}  // namespace motex
