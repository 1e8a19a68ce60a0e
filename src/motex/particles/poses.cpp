// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/poses.h"

#include <algorithm>
#include <cmath>

#include "motex/particles/clusters.h"

namespace motex {
namespace {

constexpr double kMeanPrior = 5;  // frames of the species' mean that count beside those of a cable
constexpr Index kMostTrainingRows = 4000;
constexpr int kChainSteps = 20;
constexpr double kLeastReturns = 0.1;  // share of the cables that change state
constexpr double kTrustOfCrowded = 0.1;

Index num_rows(const std::vector<PoseSequence>& cables) {
  Index num = 0;
  for (const PoseSequence& cable : cables) num += cable.patches.rows();
  return num;
}

/// All patches of all cables minus (nearly) the mean of their cable.
Matrix deviations(const std::vector<PoseSequence>& cables) {
  const Index dims = cables[0].patches.cols();
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(dims);
  for (const PoseSequence& cable : cables) mean += cable.patches.colwise().sum();
  mean /= static_cast<double>(std::max<Index>(1, num_rows(cables)));
  Matrix out(num_rows(cables), dims);
  Index row = 0;
  for (const PoseSequence& cable : cables) {
    const Index num = cable.patches.rows();
    if (num == 0) continue;
    Eigen::RowVectorXd own = Eigen::RowVectorXd::Zero(dims);
    double usable = 0;
    for (Index i = 0; i < num; ++i)
      if (cable.is_usable[static_cast<std::size_t>(i)] != 0) {
        own += cable.patches.row(i);
        usable += 1;
      }
    own = (own + kMeanPrior * mean) / (usable + kMeanPrior);
    out.middleRows(row, num) = cable.patches.rowwise() - own;
    row += num;
  }
  return out;
}

Matrix usable_rows(const Matrix& rows, const std::vector<PoseSequence>& cables) {
  std::vector<Index> chosen;
  Index row = 0;
  for (const PoseSequence& cable : cables)
    for (const char usable : cable.is_usable) {
      if (usable != 0) chosen.push_back(row);
      ++row;
    }
  const auto stride = std::max<std::size_t>(1, chosen.size() / static_cast<std::size_t>(kMostTrainingRows));
  Matrix out(static_cast<Index>((chosen.size() + stride - 1) / stride), rows.cols());
  for (std::size_t i = 0; i < chosen.size(); i += stride) out.row(static_cast<Index>(i / stride)) = rows.row(chosen[i]);
  return out;
}

/// A chain over states with the emission likelihoods of each frame given.
struct Chain {
  Eigen::VectorXd start;
  Matrix transitions;
};

/// Expected transitions of one sequence under the chain, added to counts (forward–backward, normalised a frame).
void add_expected(const Chain& chain, const Matrix& likelihoods, Matrix& counts, Eigen::VectorXd& starts) {
  const Index num = likelihoods.rows(), k = likelihoods.cols();
  Matrix forward(num, k), backward = Matrix::Ones(num, k);
  for (Index t = 0; t < num; ++t) {
    const Eigen::RowVectorXd before = t == 0 ? Eigen::RowVectorXd(chain.start.transpose())
                                             : Eigen::RowVectorXd(forward.row(t - 1) * chain.transitions);
    forward.row(t) = before.cwiseProduct(likelihoods.row(t));
    forward.row(t) /= std::max(1e-300, forward.row(t).sum());
  }
  for (Index t = num - 1; t-- > 0;) {
    backward.row(t) =
        (chain.transitions * backward.row(t + 1).cwiseProduct(likelihoods.row(t + 1)).transpose()).transpose();
    backward.row(t) /= std::max(1e-300, backward.row(t).sum());
  }
  const Eigen::RowVectorXd first = forward.row(0).cwiseProduct(backward.row(0));
  starts += first.transpose() / std::max(1e-300, first.sum());
  for (Index t = 0; t + 1 < num; ++t) {
    Matrix pair = (forward.row(t).transpose() * likelihoods.row(t + 1).cwiseProduct(backward.row(t + 1)))
                      .cwiseProduct(chain.transitions);
    counts += pair / std::max(1e-300, pair.sum());
  }
}

Chain fitted_chain(const std::vector<Matrix>& likelihoods, Index k) {
  Chain chain{Eigen::VectorXd::Constant(k, 1.0 / static_cast<double>(k)),
              Matrix::Constant(k, k, 0.5 / static_cast<double>(k))};
  chain.transitions.diagonal().array() += 0.5;
  for (int step = 0; step < kChainSteps; ++step) {
    Matrix counts = Matrix::Constant(k, k, 1.0 / static_cast<double>(k));
    Eigen::VectorXd starts = Eigen::VectorXd::Ones(k);
    for (const Matrix& sequence : likelihoods)
      if (sequence.rows() > 0) add_expected(chain, sequence, counts, starts);
    chain.transitions = counts.array().colwise() / counts.rowwise().sum().array();
    chain.start = starts / starts.sum();
  }
  return chain;
}

/// The most probable states (Viterbi).
std::vector<int> best_states(const Chain& chain, const Matrix& likelihoods) {
  const Index num = likelihoods.rows(), k = likelihoods.cols();
  std::vector<int> states(static_cast<std::size_t>(num), 0);
  if (num == 0) return states;
  const Matrix steps = chain.transitions.array().max(1e-12).log(), scores = likelihoods.array().max(1e-300).log();
  Matrix best(num, k);
  Eigen::MatrixXi from = Eigen::MatrixXi::Zero(num, k);
  best.row(0) = scores.row(0) + chain.start.array().max(1e-12).log().matrix().transpose();
  for (Index t = 1; t < num; ++t)
    for (Index j = 0; j < k; ++j) {
      Index came = 0;
      best(t, j) = (best.row(t - 1).transpose() + steps.col(j)).maxCoeff(&came) + scores(t, j);
      from(t, j) = static_cast<int>(came);
    }
  Index last = 0;
  best.row(num - 1).maxCoeff(&last);
  for (Index t = num; t-- > 0;) {
    states[static_cast<std::size_t>(t)] = static_cast<int>(last);
    last = from(t, last);
  }
  return states;
}

/// Likelihoods of each cable's frames, scaled to 1 at most a frame; flatter where others are near.
std::vector<Matrix> likelihoods_of(const Matrix& places, const Clusters& clusters,
                                   const std::vector<PoseSequence>& cables) {
  std::vector<Matrix> out;
  Index row = 0;
  for (const PoseSequence& cable : cables) {
    Matrix scores = cluster_log_densities(places.middleRows(row, cable.patches.rows()), clusters, false);
    for (Index t = 0; t < scores.rows(); ++t) {
      const double trust = cable.is_usable[static_cast<std::size_t>(t)] != 0 ? 1 : kTrustOfCrowded;
      scores.row(t) = (trust * (scores.row(t).array() - scores.row(t).maxCoeff())).exp();
    }
    out.push_back(std::move(scores));
    row += cable.patches.rows();
  }
  return out;
}

/// Whether cables come back to a state that they had left.
bool are_recurrent(const std::vector<std::vector<int>>& sequences, int k) {
  int changing = 0, returning = 0;
  for (const std::vector<int>& states : sequences) {
    std::vector<char> left(static_cast<std::size_t>(k), 0);
    bool changes = false, returns = false;
    for (std::size_t t = 1; t < states.size(); ++t) {
      if (states[t] == states[t - 1]) continue;
      changes = true;
      left[static_cast<std::size_t>(states[t - 1])] = 1;
      returns |= left[static_cast<std::size_t>(states[t])] != 0;
    }
    changing += changes ? 1 : 0;
    returning += returns ? 1 : 0;
  }
  return returning > kLeastReturns * changing;
}

Poses one_pose(const std::vector<PoseSequence>& cables) {
  Poses out;
  for (const PoseSequence& cable : cables) out.sequences.emplace_back(cable.is_usable.size(), 0);
  out.transitions = TransitionMatrix::from_sequences(1, out.sequences, 0);
  return out;
}

}  // namespace

Poses find_poses(const std::vector<PoseSequence>& cables, const FindPosesOptions& options) {
  if (options.max_poses < 2 || num_rows(cables) == 0) return one_pose(cables);
  const Matrix all = deviations(cables), training = usable_rows(all, cables);
  if (training.rows() < 20) return one_pose(cables);
  const PrincipalAxes axes = principal_axes(training, 0.7, 2, 6);
  if (axes.variance < options.min_variance) return one_pose(cables);
  ChooseClustersOptions choose;
  choose.max_clusters = options.max_poses;
  choose.min_silhouette = options.min_silhouette;
  choose.min_distance = options.min_distance;
  choose.min_share = 0.05;
  choose.min_points = 8;
  choose.seed = options.seed;
  const Clusters clusters = choose_clusters(coordinates(training, axes), choose);
  if (clusters.num() < 2) return one_pose(cables);
  const std::vector<Matrix> likelihoods = likelihoods_of(coordinates(all, axes), clusters, cables);
  const Chain chain = fitted_chain(likelihoods, clusters.num());
  Poses out;
  out.silhouette = clusters.silhouette;
  for (const Matrix& sequence : likelihoods) out.sequences.push_back(best_states(chain, sequence));
  if (!are_recurrent(out.sequences, clusters.num())) return one_pose(cables);
  out.transitions = TransitionMatrix::from_sequences(clusters.num(), out.sequences, options.prior_count);
  return out;
}

}  // namespace motex
