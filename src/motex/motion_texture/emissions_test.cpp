// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/emissions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/lds/synthetic.h"
#include "motex/motion_texture/subspace.h"
#include "motex/motion_texture/synthetic.h"
#include "motex/motion_texture/texton_fitter.h"

namespace motex {
namespace {

/// The formula of the header, frame by frame in double precision.
double slow_emission(const Corpus& corpus, Index t, const Subspace& space, const Lds& lds, double deviation) {
  const auto state = [&](Index row) -> Vector {
    return space.basis.transpose() * (corpus.features.row(row).transpose() - space.mean);
  };
  const Index d = lds.state_size();
  const Vector residual =
      state(t) - lds.transition.leftCols(d) * state(t - 1) - lds.transition.rightCols(d) * state(t - 2) - lds.offset;
  const Vector outside = corpus.features.row(t).transpose() - space.mean - space.basis * state(t);
  const Vector white = lds.noise_chol.triangularView<Eigen::Lower>().solve(residual);
  const auto gap = static_cast<double>(corpus.features.cols() - d);
  return -0.5 * (static_cast<double>(d) * std::log(2 * std::numbers::pi) + lds.log_det + white.squaredNorm() +
                 gap * std::log(2 * std::numbers::pi * deviation * deviation) +
                 outside.squaredNorm() / (deviation * deviation));
}

struct Case {
  PlantedCorpus planted;
  std::vector<Subspace> subspaces;
  std::vector<Lds> systems;
};

Case many_textons(bool shared) {
  Case c;
  PlantedCorpusOptions options;
  options.num_features = 20;
  options.segments_per_run = 5;
  c.planted = planted_corpus(options);
  Rng rng(7);
  // More textons than one tile of the matrix product holds.
  for (int i = 0; i < 130; ++i) {
    const Index d = shared ? 5 : 3 + i % 4;
    const FrameMatrix part = c.planted.corpus.features.middleRows(2 * i, 60);
    c.subspaces.push_back(shared && i > 0 ? c.subspaces[0] : principal_subspace(part, d, 0, 0, 0));
    c.systems.push_back(random_lds(rng, d));
  }
  return c;
}

void expect_emissions(const Case& c, bool shared, int jobs) {
  const Corpus& corpus = c.planted.corpus;
  EmissionBank bank(corpus.features, corpus.runs, shared ? c.subspaces.data() : nullptr, 1.7);
  std::vector<int> all;
  for (int i = 0; i < static_cast<int>(c.systems.size()); ++i) {
    bank.set_texton(i, c.subspaces[static_cast<std::size_t>(i)], c.systems[static_cast<std::size_t>(i)]);
    all.push_back(i);
  }
  FrameMatrixF values = FrameMatrixF::Constant(corpus.features.rows(), bank.num_textons(), 99);
  JobContext job;
  job.jobs = jobs;
  bank.evaluate(all, values, job);
  for (const Run& run : corpus.runs) {
    EXPECT_EQ(values.middleRows(run.row, 2).norm(), 0) << "nothing precedes them";
    for (Index t = run.row + 2; t < run.row + run.length; t += 7)
      for (const int i : {0, 1, 64, 129}) {
        const auto n = static_cast<std::size_t>(i);
        const double slow = slow_emission(corpus, t, c.subspaces[n], c.systems[n], 1.7);
        EXPECT_NEAR(values(t, i), slow, 1e-5 * std::abs(slow) + 1e-3) << "frame " << t << ", texton " << i;
      }
  }
}

TEST(EmissionBank, EqualsTheFormulaInASharedBasis) { expect_emissions(many_textons(true), true, 1); }
TEST(EmissionBank, EqualsTheFormulaInOwnBases) { expect_emissions(many_textons(false), false, 2); }

TEST(EmissionBank, EvaluatesOnlyTheNamedTextons) {
  const Case c = many_textons(true);
  const Corpus& corpus = c.planted.corpus;
  EmissionBank bank(corpus.features, corpus.runs, c.subspaces.data(), 1);
  for (int i = 0; i < 3; ++i) bank.set_texton(i, c.subspaces[0], c.systems[static_cast<std::size_t>(i)]);
  FrameMatrixF values = FrameMatrixF::Constant(corpus.features.rows(), 3, 99), all = values;
  bank.evaluate({0, 1, 2}, all, {});
  bank.evaluate({1}, values, {});
  EXPECT_EQ(values(5, 0), 99);
  EXPECT_EQ(values.col(1), all.col(1));
  EXPECT_EQ(values(5, 2), 99);
}

TEST(EmissionBank, CanBeCancelled) {
  const Case c = many_textons(true);
  const Corpus& corpus = c.planted.corpus;
  EmissionBank bank(corpus.features, corpus.runs, c.subspaces.data(), 1);
  bank.set_texton(0, c.subspaces[0], c.systems[0]);
  FrameMatrixF values(corpus.features.rows(), 1);
  const std::atomic<bool> cancel{true};
  JobContext job;
  job.cancel = &cancel;
  EXPECT_THROW(bank.evaluate({0}, values, job), Cancelled);
}

TEST(EmissionBank, SumsToTheLikelihoodOfTheStatistics) {
  const PlantedCorpus planted = planted_corpus();
  const TextonFitter fitter(planted.corpus, {});
  const LabelledSegment& segment = planted.segments[1];
  const TextonFit fit = fitter.fit({&segment, 1}, 30);
  EmissionBank bank(planted.corpus.features, planted.corpus.runs, &fitter.shared(), 1);
  bank.set_texton(0, fitter.shared(), fit.dynamics);
  FrameMatrixF values(planted.corpus.features.rows(), 1);
  bank.evaluate({0}, values, {});
  double slow = log_likelihood(fit.dynamics, fit.statistics);
  const Subspace& space = fitter.shared();
  for (Index t = segment.row; t < segment.row + segment.length; ++t) {
    const Vector y = planted.corpus.features.row(t).transpose() - space.mean;
    slow -= 0.5 * (y.squaredNorm() - (space.basis.transpose() * y).squaredNorm()) +
            0.5 * static_cast<double>(y.size() - space.basis.cols()) * std::log(2 * std::numbers::pi);
  }
  EXPECT_NEAR(values.middleRows(segment.row, segment.length).cast<double>().sum(), slow, 1e-5 * std::abs(slow));
}

}  // namespace
}  // namespace motex
