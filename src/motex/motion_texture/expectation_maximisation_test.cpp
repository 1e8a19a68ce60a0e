// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/expectation_maximisation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "motex/core/error.h"
#include "motex/motion_texture/initial_segments.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

struct Way {
  Basis basis;
  Init init;
  bool common_dynamics = false;
};

LearnOptions learn_options(const Way& way) {
  LearnOptions options;
  options.basis = way.basis;
  options.common_dynamics = way.common_dynamics;
  options.state_size = 3;
  return options;
}

Segmentation start(const Corpus& corpus, const TextonFitter& fitter, Init init, Index min_frames) {
  if (init == Init::kMerge) return merged_segments(corpus, fitter, 0, min_frames, {});
  return greedy_segments(corpus, fitter, 0.45 * random_pose_distance(corpus, 1), min_frames, 150, {});
}

TEST(ExpectationMaximisation, TheObjectiveNeverFalls) {
  for (const Way way :
       {Way{Basis::kShared, Init::kMerge}, Way{Basis::kShared, Init::kGreedy}, Way{Basis::kShared, Init::kMerge, true},
        Way{Basis::kOwn, Init::kMerge}, Way{Basis::kOwn, Init::kGreedy}})
    for (const std::uint64_t seed : {1, 2}) {
      PlantedCorpusOptions planting;
      planting.seed = seed;
      planting.outside = 2;
      const PlantedCorpus truth = planted_corpus(planting);
      const LearnOptions options = learn_options(way);
      const TextonFitter fitter(truth.corpus, options);
      ExpectationMaximisation em(truth.corpus, fitter, options, 40, 150, start(truth.corpus, fitter, way.init, 40));
      double before = -HUGE_VAL;
      int iterations = 0;
      for (; iterations < 30 && !em.converged(); ++iterations) {
        const double now = em.iterate({});
        // Emissions are single precision.
        EXPECT_GE(now, before - 1e-6 * std::abs(before)) << "iteration " << iterations;
        before = now;
      }
      EXPECT_GE(iterations, 2);
      EXPECT_GE(em.outside_deviation(), 1);
    }
}

TEST(ExpectationMaximisation, TheObjectiveNeverFallsWithPaths) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    PlantedCorpusOptions planting;
    planting.seed = seed;
    const PlantedCorpus truth = planted_corpus(planting);
    const LearnOptions options = learn_options({Basis::kShared, Init::kMerge});
    const TextonFitter fitter(truth.corpus, options);
    const MovePaths paths(fitter.shared_states(), truth.corpus.runs, 40, 3);
    ExpectationMaximisation em(truth.corpus, fitter, options, 40, 150, merged_moves(truth.corpus, paths, 4, 40, {}),
                               &paths);
    double before = -HUGE_VAL;
    int iterations = 0;
    for (; iterations < 30 && !em.converged(); ++iterations) {
      const double now = em.iterate({});
      EXPECT_GE(now, before - 1e-6 * std::abs(before)) << "iteration " << iterations;
      before = now;
    }
    EXPECT_GE(iterations, 2);
  }
}

TEST(ExpectationMaximisation, FindsThePlantedSegments) {
  for (const Basis basis : {Basis::kShared, Basis::kOwn})
    for (const std::uint64_t seed : {3, 4, 5}) {
      PlantedCorpusOptions planting;
      planting.seed = seed;
      const PlantedCorpus truth = planted_corpus(planting);
      const LearnOptions options = learn_options({basis, Init::kMerge});
      const TextonFitter fitter(truth.corpus, options);
      // Pieces of 30 frames cross most boundaries: EM has to move them.
      ExpectationMaximisation em(truth.corpus, fitter, options, 30, 150,
                                 merged_segments(truth.corpus, fitter, 0, 30, {}));
      for (int i = 0; i < 20 && !em.converged(); ++i) em.iterate({});
      EXPECT_GT(label_agreement(em.segments(), truth.segments, 8), 0.95) << "seed " << seed;
      for (const LabelledSegment& s : em.segments()) {
        EXPECT_GE(s.length, 30);
        EXPECT_LE(s.length, 150);
      }
    }
}

TEST(ExpectationMaximisation, TheOutsideDeviationIsThePlantedOne) {
  PlantedCorpusOptions planting;
  planting.outside = 2.5;
  const PlantedCorpus truth = planted_corpus(planting);
  for (const Basis basis : {Basis::kShared, Basis::kOwn}) {
    const LearnOptions options = learn_options({basis, Init::kMerge});
    const TextonFitter fitter(truth.corpus, options);
    ExpectationMaximisation em(truth.corpus, fitter, options, 40, 150, truth.segments);
    em.iterate({});
    EXPECT_NEAR(em.outside_deviation(), 2.5, 0.25) << "own subspaces take a little of it in";
  }
}

TEST(ExpectationMaximisation, DoesNotDependOnThreads) {
  const PlantedCorpus truth = planted_corpus();
  for (const Basis basis : {Basis::kShared, Basis::kOwn}) {
    const LearnOptions options = learn_options({basis, Init::kMerge});
    const TextonFitter fitter(truth.corpus, options);
    const Segmentation first = merged_segments(truth.corpus, fitter, 0, 40, {});
    ExpectationMaximisation one(truth.corpus, fitter, options, 40, 150, first);
    ExpectationMaximisation two(truth.corpus, fitter, options, 40, 150, first);
    JobContext job_one, job_two;
    job_one.jobs = 1, job_two.jobs = 2;
    for (int i = 0; i < 4; ++i) EXPECT_EQ(one.iterate(job_one), two.iterate(job_two));
  }
}

TEST(ExpectationMaximisation, CanBeCancelled) {
  const PlantedCorpus truth = planted_corpus();
  const LearnOptions options = learn_options({Basis::kShared, Init::kMerge});
  const TextonFitter fitter(truth.corpus, options);
  ExpectationMaximisation em(truth.corpus, fitter, options, 40, 150, truth.segments);
  const std::atomic<bool> cancel{true};
  JobContext job;
  job.cancel = &cancel;
  EXPECT_THROW(em.iterate(job), Cancelled);
}

}  // namespace
}  // namespace motex
