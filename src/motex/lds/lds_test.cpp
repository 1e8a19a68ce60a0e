// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/lds/lds.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/lds/bridge.h"
#include "motex/lds/synthetic.h"

namespace motex {
namespace {

TEST(LdsStatistics, AddOverSegmentsLikeOverFrames) {
  Rng rng(1);
  const FrameMatrix x = sample_states(random_lds(rng, 3), rng, 50);
  LdsStatistics whole(3), parts(3);
  whole.add(x, 2, 48);
  parts.add(x, 2, 20);
  LdsStatistics rest(3);
  rest.add(x, 22, 28);
  parts += rest;
  EXPECT_TRUE(parts.moments.isApprox(whole.moments, 1e-12));
  EXPECT_EQ(whole.count(), 48);
  EXPECT_THROW(whole.add(x, 1, 5), InvalidInput);
  EXPECT_THROW(whole.add(x, 2, 49), InvalidInput);
}

TEST(FitLds, FindsTheSystemThatMadeTheData) {
  Rng rng(2);
  const Lds truth = random_lds(rng, 4);
  const FrameMatrix x = sample_states(truth, rng, 60000);
  LdsStatistics statistics(4);
  statistics.add(x, 2, x.rows() - 2);
  const Lds found = fit_lds(statistics, make_prior(statistics, 1));
  EXPECT_NEAR(spectral_radius(found), spectral_radius(truth), 0.01);
  EXPECT_LT((found.noise_cov - truth.noise_cov).norm(), 0.05 * truth.noise_cov.norm());
  EXPECT_LT((found.transition - truth.transition).norm(), 0.05 * truth.transition.norm());
}

TEST(FitLds, LikelihoodIsTheSumOverFramesAndTheFitIsItsMaximum) {
  Rng rng(3);
  const Lds truth = random_lds(rng, 3);
  const FrameMatrix x = sample_states(truth, rng, 300);
  LdsStatistics statistics(3);
  statistics.add(x, 2, 298);
  double sum = 0;
  const Matrix inverse = truth.noise_cov.inverse();
  for (Index t = 2; t < 300; ++t) {
    const Vector r = x.row(t).transpose() - truth.transition.leftCols(3) * x.row(t - 1).transpose() -
                     truth.transition.rightCols(3) * x.row(t - 2).transpose() - truth.offset;
    sum += -0.5 * (3 * std::log(2 * std::numbers::pi) + std::log(truth.noise_cov.determinant()) + r.dot(inverse * r));
  }
  EXPECT_NEAR(log_likelihood(truth, statistics), sum, 1e-8 * std::abs(sum));
  const LdsPrior prior = make_prior(statistics, 20);
  const auto posterior = [&](const Lds& lds) { return log_likelihood(lds, statistics) + log_prior(lds, prior); };
  const Lds best = fit_lds(statistics, prior);
  EXPECT_LE(log_prior(best, prior), 1e-9);
  for (int i = 0; i < 50; ++i) {
    Lds other = best;
    other.transition += 1e-3 * Matrix::Random(3, 6);
    other.offset += 1e-3 * Vector::Random(3);
    other.set_noise(best.noise_cov + 1e-3 * Matrix::Identity(3, 3) * rng.uniform(-1, 1));
    EXPECT_LT(posterior(other), posterior(best));
  }
}

TEST(FitLds, NoFrameGivesThePrior) {
  Rng rng(4);
  const FrameMatrix x = sample_states(random_lds(rng, 3), rng, 300);
  LdsStatistics corpus(3);
  corpus.add(x, 2, 298);
  const LdsPrior prior = make_prior(corpus, 30);
  const Lds fit = fit_lds(LdsStatistics(3), prior);
  EXPECT_NEAR(log_prior(fit, prior), 0, 1e-8);
}

/// log of the predictive density product: p(x_t | x_<t) is a matrix-t; here by the ratio of evidences, checked against
/// brute-force sampling of nothing but the definition in one dimension.
TEST(LdsEvidence, IsTheIntegralInOneDimension) {
  Rng rng(5);
  const FrameMatrix x = sample_states(random_lds(rng, 1), rng, 400);
  LdsStatistics corpus(1), few(1);
  corpus.add(x, 2, 398);
  few.add(x, 100, 5);
  const double nu0 = 12;
  const LdsEvidence evidence(corpus, nu0);
  // Monte Carlo: draw (A, D, σ²) from the prior, average the likelihood.
  const Matrix m = corpus.moments * (nu0 / corpus.count());
  Matrix zz(3, 3);
  Vector zy(3);
  for (int i = 0; i < 3; ++i) {
    zy[i] = m(i + 1, 0);
    for (int j = 0; j < 3; ++j) zz(i, j) = m(i + 1, j + 1);
  }
  const Matrix cov = zz.inverse();
  const Vector mean = cov * zy;
  const double psi = m(0, 0) - zy.dot(mean);
  const Matrix root = Eigen::LLT<Matrix>(cov).matrixL();
  double sum = 0;
  const int n = 400000;
  for (int i = 0; i < n; ++i) {
    double chi = 0;
    for (int k = 0; k < static_cast<int>(nu0); ++k) chi += std::pow(rng.normal(), 2);
    const double variance = psi / chi;
    const Vector theta = mean + std::sqrt(variance) * root * normal_vector(rng, 3);
    Lds lds;
    lds.transition = theta.head(2).transpose();
    lds.offset = theta.tail(1);
    lds.set_noise(Matrix::Constant(1, 1, variance));
    sum += std::exp(log_likelihood(lds, few));
  }
  EXPECT_NEAR(evidence(few), std::log(sum / n), 0.02);
}

TEST(LdsEvidence, PrefersTheRightGrouping) {
  Rng rng(6);
  const Lds a = random_lds(rng, 3), b = random_lds(rng, 3);
  const FrameMatrix xa = sample_states(a, rng, 400), xb = sample_states(b, rng, 400);
  const auto part = [](const FrameMatrix& x, Index first) {
    LdsStatistics s(3);
    s.add(x, first, 190);
    return s;
  };
  LdsStatistics corpus = part(xa, 2);
  for (const auto& s : {part(xa, 200), part(xb, 2), part(xb, 200)}) corpus += s;
  const LdsEvidence evidence(corpus, 30);
  EXPECT_GT(evidence(part(xa, 2), part(xa, 200)), evidence(part(xa, 2)) + evidence(part(xa, 200)));
  EXPECT_LT(evidence(part(xa, 2), part(xb, 2)), evidence(part(xa, 2)) + evidence(part(xb, 2)));
}

/// Dense least squares of eq. 8.
FrameMatrix dense_bridge(const Lds& lds, FrameMatrix states, const FrameMatrix& noise) {
  const Index d = lds.state_size(), l = states.rows(), m = l - 4;
  const Matrix w = whitening(lds);
  Matrix a = Matrix::Zero((l - 2) * d, m * d);
  Vector b((l - 2) * d);
  for (Index e = 0; e < l - 2; ++e) {
    Vector rhs = noise.row(e).transpose() - w.col(3 * d);
    for (Index lag = 0; lag < 3; ++lag) {
      const Index t = e + 2 - lag;
      if (t >= 2 && t < l - 2)
        a.block(e * d, (t - 2) * d, d, d) = w.middleCols(lag * d, d);
      else
        rhs -= w.middleCols(lag * d, d) * states.row(t).transpose();
    }
    b.segment(e * d, d) = rhs;
  }
  const Vector x = (a.transpose() * a).ldlt().solve(a.transpose() * b);
  for (Index t = 2; t < l - 2; ++t) states.row(t) = x.segment((t - 2) * d, d).transpose();
  return states;
}

TEST(Bridge, EqualsDenseLeastSquaresForEveryLength) {
  Rng rng(7);
  const Lds lds = random_lds(rng, 3);
  Bridge bridge(lds);
  for (const Index l : {4, 5, 6, 7, 8, 9, 12, 40, 90, 150, 11}) {
    FrameMatrix states = FrameMatrix::Random(l, 3);
    const FrameMatrix noise = FrameMatrix::Random(l - 2, 3);
    const FrameMatrix expected = l > 4 ? dense_bridge(lds, states, noise) : states;
    bridge.solve(states, noise);
    EXPECT_LT((states - expected).norm(), 1e-7 * (1 + expected.norm())) << l;
  }
}

TEST(Bridge, ReproducesAPathFromItsOwnEndsAndNoise) {
  Rng rng(8);
  const Lds lds = random_lds(rng, 5);
  const FrameMatrix truth = sample_states(lds, rng, 80);
  FrameMatrix noise(78, 5);
  const Matrix w = whitening(lds);
  for (Index t = 2; t < 80; ++t) {
    Vector u(16);
    u << truth.row(t).transpose(), truth.row(t - 1).transpose(), truth.row(t - 2).transpose(), 1;
    noise.row(t - 2) = (w * u).transpose();
  }
  FrameMatrix states = truth;
  states.middleRows(2, 76).setZero();
  Bridge(lds).solve(states, noise);
  EXPECT_LT((states - truth).norm(), 1e-8 * truth.norm());
}

TEST(Bridge, ServesSystemsThatGrow) {
  Rng rng(10);
  Lds lds = random_lds(rng, 3);
  lds.transition.leftCols(3) *= 1.15;  // every mode 15 % further out: the Gramian of 200 steps is singular in doubles
  lds.transition.rightCols(3) *= 1.15 * 1.15;
  ASSERT_GT(spectral_radius(lds), 1.03);
  Bridge bridge(lds);
  for (const Index l : {5, 30, 200, 400}) {
    FrameMatrix states = FrameMatrix::Random(l, 3);
    const FrameMatrix noise = FrameMatrix::Random(l - 2, 3);
    const FrameMatrix expected = dense_bridge(lds, states, noise);
    bridge.solve(states, noise);
    EXPECT_LT((states - expected).norm(), 1e-6 * (1 + expected.norm())) << l;
  }
}

TEST(BandedBridge, EqualsBridge) {
  Rng rng(11);
  const Lds lds = random_lds(rng, 4);
  for (const Index l : {4, 5, 6, 7, 60}) {
    FrameMatrix a = FrameMatrix::Random(l, 4), b = a;
    const FrameMatrix noise = FrameMatrix::Random(l - 2, 4);
    Bridge(lds).solve(a, noise);
    BandedBridge(lds).solve(b, noise);
    EXPECT_LT((a - b).norm(), 1e-8 * (1 + a.norm())) << l;
  }
}

TEST(Bridge, MeetsEndsFarFromTheModel) {
  Rng rng(9);
  Bridge bridge(random_lds(rng, 2));
  FrameMatrix states = FrameMatrix::Zero(60, 2);
  states.bottomRows(2).setConstant(1000);
  bridge.solve(states, FrameMatrix::Zero(58, 2));
  EXPECT_EQ(states(59, 1), 1000);
  EXPECT_TRUE(states.allFinite());
  EXPECT_THROW(bridge.solve(states, FrameMatrix::Zero(10, 2)), InvalidInput);
}

}  // namespace
}  // namespace motex
