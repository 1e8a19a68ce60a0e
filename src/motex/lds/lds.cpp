// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/lds/lds.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"

namespace motex {
namespace {

/// [I −A] S [I −A]ᵀ: scatter of x_t − A [x_{t−1}; x_{t−2}].
Matrix residual_scatter(const Matrix& a, const Matrix& s) {
  const Index d = a.rows();
  const Matrix cross = a * s.bottomLeftCorner(2 * d, d);
  return s.topLeftCorner(d, d) - cross - cross.transpose() + a * s.bottomRightCorner(2 * d, 2 * d) * a.transpose();
}

/// tr(Σ⁻¹ R).
double trace_solve(const Lds& lds, const Matrix& r) {
  const auto b = lds.noise_chol.triangularView<Eigen::Lower>();
  return b.transpose().solve(b.solve(r)).trace();
}

Lds fit_given(const Matrix& transition, const CentredMoments& own, const Matrix& scatter, const LdsPrior& prior) {
  const Index d = transition.rows();
  Lds lds;
  lds.transition = transition;
  const Vector& mean = own.count > 0 ? own.mean : prior.mean;
  lds.offset = mean.head(d) - transition * mean.tail(2 * d);
  lds.set_noise(residual_scatter(transition, scatter) / (own.count + prior.frames));
  return lds;
}

double log_multigamma(Index d, double a) {
  double sum = static_cast<double>(d * (d - 1)) / 4 * std::log(std::numbers::pi);
  for (Index i = 0; i < d; ++i) sum += std::lgamma(a - static_cast<double>(i) / 2);
  return sum;
}

Index reordered(Index i, Index d) { return i < 2 * d ? d + i : i == 2 * d ? 3 * d : i - 2 * d - 1; }

}  // namespace

void Lds::set_noise(const Matrix& covariance) {
  noise_cov = (covariance + covariance.transpose()) / 2;
  const Eigen::LLT<Matrix> llt(noise_cov);
  if (llt.info() != Eigen::Success || !noise_cov.allFinite())
    throw NumericalFailure("the noise covariance of a linear dynamic system is not positive definite");
  noise_chol = llt.matrixL();
  log_det = 2 * noise_chol.diagonal().array().log().sum();
}

LdsPrior make_prior(const LdsStatistics& corpus, double frames) {
  const CentredMoments moments = centred(corpus);
  if (!(moments.count > 0)) throw InvalidInput("a prior needs at least one frame");
  LdsPrior prior{moments.mean, moments.scatter / moments.count, frames};
  const double ridge = 1e-9 * prior.covariance.trace() / static_cast<double>(prior.covariance.rows()) + 1e-12;
  prior.covariance.diagonal().array() += ridge;
  return prior;
}

Lds fit_lds(const LdsStatistics& statistics, const LdsPrior& prior) {
  const CentredMoments own = centred(statistics);
  const Matrix s = own.scatter + prior.frames * prior.covariance;
  const Index d = statistics.state_size();
  const Eigen::LLT<Matrix> regressors(s.bottomRightCorner(2 * d, 2 * d));
  if (regressors.info() != Eigen::Success)
    throw NumericalFailure("the states of a texton do not vary enough to be fitted");
  const Matrix transition = regressors.solve(s.bottomLeftCorner(2 * d, d)).transpose();
  return fit_given(transition, own, s, prior);
}

Lds fit_noise(const LdsStatistics& statistics, const LdsPrior& prior, const Matrix& transition) {
  const CentredMoments own = centred(statistics);
  return fit_given(transition, own, own.scatter + prior.frames * prior.covariance, prior);
}

double log_likelihood(const Lds& lds, const LdsStatistics& statistics) {
  const Matrix w = whitening(lds);
  const double squares = (w * statistics.moments).cwiseProduct(w).sum();
  const auto d = static_cast<double>(lds.state_size());
  return -0.5 * (statistics.count() * (d * std::log(2 * std::numbers::pi) + lds.log_det) + squares);
}

double log_prior(const Lds& lds, const LdsPrior& prior) {
  const LdsStatistics none(lds.state_size());
  LdsPrior unit = prior;
  unit.frames = 1;
  const Lds mode = fit_lds(none, unit);
  const auto d = static_cast<double>(lds.state_size());
  return -0.5 * prior.frames *
         (lds.log_det - mode.log_det + trace_solve(lds, residual_scatter(lds.transition, prior.covariance)) - d);
}

LdsEvidence::LdsEvidence(const LdsStatistics& corpus, double prior_frames) : d_(corpus.state_size()) {
  const Index n = corpus.moments.rows();
  nu0_ = std::max(prior_frames, static_cast<double>(d_) + 2);
  if (!(corpus.count() > 0)) throw InvalidInput("a prior needs at least one frame");
  prior_.resize(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      prior_(i, j) = corpus.moments(reordered(i, d_), reordered(j, d_)) * nu0_ / corpus.count();
  prior_.diagonal().array() += 1e-9 * prior_.trace() / static_cast<double>(n) + 1e-12;
  const Eigen::LLT<Matrix> llt(prior_);
  if (llt.info() != Eigen::Success) throw NumericalFailure("the corpus does not vary enough to be a prior");
  const Vector logs = 2 * llt.matrixLLT().diagonal().array().log();
  log_det_lambda0_ = logs.head(2 * d_ + 1).sum();
  log_det_psi0_ = logs.tail(d_).sum();
}

double LdsEvidence::evaluate(Matrix& joint, double count) const {
  const Eigen::LLT<Eigen::Ref<Matrix>> llt(joint);
  if (llt.info() != Eigen::Success) throw NumericalFailure("evidence of a texton: moments are not positive definite");
  const Vector logs = 2 * joint.diagonal().array().log();
  const double nu = nu0_ + count;
  const auto d = static_cast<double>(d_);
  return -0.5 * count * d * std::log(std::numbers::pi) + log_multigamma(d_, nu / 2) - log_multigamma(d_, nu0_ / 2) +
         0.5 * d * (log_det_lambda0_ - logs.head(2 * d_ + 1).sum()) + 0.5 * nu0_ * log_det_psi0_ -
         0.5 * nu * logs.tail(d_).sum();
}

double LdsEvidence::operator()(const LdsStatistics& a, const LdsStatistics& b) const {
  Matrix joint = prior_;
  const Index n = joint.rows();
  // Lower triangle only: that is what the factorisation reads.
  for (Index j = 0; j < n; ++j)
    for (Index i = j; i < n; ++i) {
      const Index ri = reordered(i, d_), rj = reordered(j, d_);
      joint(i, j) += a.moments(ri, rj) + (b.moments.size() > 0 ? b.moments(ri, rj) : 0.0);
    }
  return evaluate(joint, a.count() + (b.moments.size() > 0 ? b.count() : 0.0));
}

double LdsEvidence::operator()(const LdsStatistics& statistics) const { return (*this)(statistics, LdsStatistics()); }

Matrix whitening(const Lds& lds) {
  const Index d = lds.state_size();
  Matrix rows(d, 3 * d + 1);
  rows << Matrix::Identity(d, d), -lds.transition, -lds.offset;
  lds.noise_chol.triangularView<Eigen::Lower>().solveInPlace(rows);
  return rows;
}

void simulate(const Lds& lds, Eigen::Ref<FrameMatrix> states, Rng* rng, double noise) {
  const Index d = lds.state_size();
  if (states.cols() != d) throw InvalidInput("simulate: the states have another size than the system");
  Vector x(d), v(d);
  for (Index t = 2; t < states.rows(); ++t) {
    x.noalias() = lds.transition.leftCols(d) * states.row(t - 1).transpose();
    x.noalias() += lds.transition.rightCols(d) * states.row(t - 2).transpose();
    x += lds.offset;
    if (rng != nullptr && noise > 0) {
      for (Index i = 0; i < d; ++i) v[i] = noise * rng->normal();
      x.noalias() += lds.noise_chol.triangularView<Eigen::Lower>() * v;
    }
    states.row(t) = x.transpose();
  }
}

}  // namespace motex
