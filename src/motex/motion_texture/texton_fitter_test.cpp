// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/texton_fitter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motex/core/error.h"
#include "motex/lds/synthetic.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

Segmentation of_texton(const PlantedCorpus& planted, int texton) {
  Segmentation out;
  for (const LabelledSegment& s : planted.segments)
    if (s.texton == texton) out.push_back(s);
  return out;
}

LearnOptions with_basis(Basis basis) {
  LearnOptions options;
  options.basis = basis;
  options.state_size = 3;
  return options;
}

TEST(TextonFitter, CommonDynamicsIsForTheSharedBasis) {
  const PlantedCorpus planted = planted_corpus();
  LearnOptions options = with_basis(Basis::kOwn);
  options.common_dynamics = true;
  EXPECT_THROW(TextonFitter(planted.corpus, options), InvalidInput);
  options.basis = Basis::kShared;
  const TextonFitter fitter(planted.corpus, options);
  const Lds a = fitter.fit(of_texton(planted, 0), 30).dynamics, b = fitter.fit(of_texton(planted, 1), 30).dynamics;
  EXPECT_EQ(a.transition, b.transition);
  EXPECT_NE(a.noise_cov, b.noise_cov);
}

TEST(TextonFitter, CountsFramesThatTwoPrecede) {
  const PlantedCorpus planted = planted_corpus();
  const TextonFitter fitter(planted.corpus, with_basis(Basis::kShared));
  const motex::Run& second = planted.corpus.runs[1];
  EXPECT_EQ(fitter.num_counted({0, 1, second.row, 60}), 58);
  EXPECT_EQ(fitter.num_counted({0, 1, second.row + 1, 60}), 59);
  EXPECT_EQ(fitter.num_counted({0, 1, second.row + 9, 60}), 60);
  EXPECT_EQ(fitter.num_counted({0, 1, second.row, 1}), 0);
}

TEST(TextonFitter, FindsThePlantedSystems) {
  PlantedCorpusOptions many;
  many.segments_per_run = 30;
  many.outside = 0.05;
  const PlantedCorpus planted = planted_corpus(many);
  for (const Basis basis : {Basis::kShared, Basis::kOwn}) {
    const TextonFitter fitter(planted.corpus, with_basis(basis));
    for (int i = 0; i < 3; ++i) {
      const Segmentation own = of_texton(planted, i);
      const TextonFit fit = fitter.fit(own, 1);
      const Lds& truth = planted.systems[static_cast<std::size_t>(i)];
      // What does not depend on the choice of coordinates: poles and the size of the noise.
      EXPECT_NEAR(spectral_radius(fit.dynamics), spectral_radius(truth), 0.02);
      EXPECT_NEAR(fit.dynamics.log_det, truth.log_det, 0.25);
      const TextonFit other = fitter.fit(of_texton(planted, (i + 1) % 3), 1);
      if (basis == Basis::kOwn) continue;
      EXPECT_GT(log_likelihood(fit.dynamics, fit.statistics), log_likelihood(other.dynamics, fit.statistics) + 100);
    }
  }
}

TEST(TextonFitter, FitIsTheMaximumOfItsOwnObjective) {
  const PlantedCorpus planted = planted_corpus();
  const TextonFitter fitter(planted.corpus, with_basis(Basis::kShared));
  const TextonFit fit = fitter.fit(of_texton(planted, 0), 100);
  const LdsPrior prior = make_prior(fitter.shared_statistics(), 100);
  const auto objective = [&](const Lds& lds) { return log_likelihood(lds, fit.statistics) + log_prior(lds, prior); };
  EXPECT_NEAR(fit.log_prior, log_prior(fit.dynamics, prior), 1e-9);
  EXPECT_LT(fit.log_prior, 0);
  Rng rng(5);
  for (int i = 0; i < 50; ++i) {
    Lds other = fit.dynamics;
    for (Index r = 0; r < 3; ++r)
      for (Index c = 0; c < 6; ++c) other.transition(r, c) += 1e-3 * rng.normal();
    // The prior moves with the texton's mean, so D follows A.
    const CentredMoments own = centred(fit.statistics);
    other.offset = own.mean.head(3) - other.transition * own.mean.tail(6);
    other.set_noise(fit.dynamics.noise_cov * rng.uniform(0.99, 1.01));
    EXPECT_LE(objective(other), objective(fit.dynamics) + 1e-9);
  }
}

TEST(TextonFitter, WithoutFramesItIsThePrior) {
  const PlantedCorpus planted = planted_corpus();
  const TextonFitter fitter(planted.corpus, with_basis(Basis::kShared));
  const TextonFit fit = fitter.fit({}, 300);
  EXPECT_EQ(fit.statistics.count(), 0);
  EXPECT_NEAR(fit.log_prior, 0, 1e-9);
  const Lds global = fit_lds(fitter.shared_statistics(), make_prior(fitter.shared_statistics(), 1));
  EXPECT_LT((fit.dynamics.transition - global.transition).norm(), 1e-6);
}

TEST(TextonFitter, OwnSubspaceOfEachTexton) {
  const PlantedCorpus planted = planted_corpus();
  const TextonFitter fitter(planted.corpus, with_basis(Basis::kOwn));
  const Segmentation own = of_texton(planted, 2);
  const TextonFit fit = fitter.fit(own, 30);
  double squares = 0, count = 0;
  for (const LabelledSegment& s : own)
    for (Index t = s.row + s.length - fitter.num_counted(s); t < s.row + s.length; ++t, ++count) {
      const Vector y = planted.corpus.features.row(t).transpose() - fit.subspace.mean;
      squares += (y - fit.subspace.basis * (fit.subspace.basis.transpose() * y)).squaredNorm();
    }
  EXPECT_NEAR(fit.outside_squares, squares, 1e-8 * squares);
  EXPECT_EQ(fit.statistics.count(), count);
  const TextonFit again = fitter.fit_within(fit.subspace, own, 30);
  EXPECT_EQ(again.dynamics.transition, fit.dynamics.transition);
  EXPECT_EQ(again.log_prior, fit.log_prior);
  LearnOptions by_variance = with_basis(Basis::kOwn);
  by_variance.state_size = 0;
  EXPECT_EQ(TextonFitter(planted.corpus, by_variance).fit(own, 30).subspace.basis.cols(), 8) << "8 to 15";
}

}  // namespace
}  // namespace motex
