// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/initial_segments.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "motex/core/error.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

int num_labels(const Segmentation& segments) {
  int most = -1;
  for (const LabelledSegment& s : segments) most = std::max(most, s.texton);
  return most + 1;
}

/// Segments tile every run in order, no shorter than min_frames; labels count from 0 by first appearance.
void expect_tiling(const Segmentation& segments, const Corpus& corpus, Index min_frames) {
  Index row = 0;
  int labels = 0;
  for (const LabelledSegment& s : segments) {
    const Run& run = corpus.runs.at(static_cast<std::size_t>(s.run_idx));
    EXPECT_EQ(s.row, row);
    EXPECT_GE(s.length, min_frames);
    EXPECT_LE(s.row + s.length, run.row + run.length);
    EXPECT_LE(s.texton, labels);
    labels = std::max(labels, s.texton + 1);
    row += s.length;
  }
  EXPECT_EQ(row, corpus.features.rows());
}

PlantedCorpus planted(int num_systems, std::uint64_t seed) {
  PlantedCorpusOptions options;
  options.num_systems = num_systems;
  options.segments_per_run = 20;
  options.outside = 0.3;
  options.min_frames = options.max_frames = 60;
  options.seed = seed;
  return planted_corpus(options);
}

LearnOptions three_states(Basis basis) {
  LearnOptions options;
  options.basis = basis;
  options.state_size = 3;
  return options;
}

TEST(MergedSegments, FindsThePlantedNumberOfSystems) {
  for (const int systems : {1, 2, 3, 4}) {
    const PlantedCorpus truth = planted(systems, static_cast<std::uint64_t>(systems));
    LearnOptions options = three_states(Basis::kShared);
    // The prior is the corpus itself: where that is one system, a strong prior explains every piece alone too.
    if (systems == 1) options.prior = 10;
    const TextonFitter fitter(truth.corpus, options);
    const Segmentation found = merged_segments(truth.corpus, fitter, 0, 60, {});
    expect_tiling(found, truth.corpus, 60);
    EXPECT_EQ(num_labels(found), systems);
    EXPECT_GT(label_agreement(found, truth.segments, 5), 0.95) << systems << " systems";
  }
}

TEST(MergedSegments, MoreMustBeGainedMoreTextonsStay) {
  const PlantedCorpus truth = planted(3, 9);
  const TextonFitter fitter(truth.corpus, three_states(Basis::kShared));
  int before = 0;
  for (const double threshold : {0.0, 20.0, 60.0, 1e6}) {
    const int now = num_labels(merged_segments(truth.corpus, fitter, threshold, 60, {}));
    EXPECT_GE(now, before);
    before = now;
  }
  EXPECT_EQ(before, 40) << "nothing is merged";
}

TEST(MergedSegments, DoNotDependOnThreads) {
  const PlantedCorpus truth = planted(3, 4);
  const TextonFitter fitter(truth.corpus, three_states(Basis::kShared));
  JobContext one, two;
  one.jobs = 1, two.jobs = 2;
  const Segmentation a = merged_segments(truth.corpus, fitter, 0, 50, one);
  const Segmentation b = merged_segments(truth.corpus, fitter, 0, 50, two);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].texton, b[i].texton);
}

TEST(GreedySegments, LargerThresholdsGiveFewerTextons) {
  const PlantedCorpus truth = planted(3, 5);
  for (const Basis basis : {Basis::kShared, Basis::kOwn}) {
    const TextonFitter fitter(truth.corpus, three_states(basis));
    const double usual = random_pose_distance(truth.corpus, 1);
    std::vector<int> counts;
    for (const double share : {0.2, 0.5, 1.0, 4.0}) {
      const Segmentation found = greedy_segments(truth.corpus, fitter, share * usual, 40, 300, {});
      expect_tiling(found, truth.corpus, 40);
      counts.push_back(num_labels(found));
    }
    EXPECT_TRUE(std::is_sorted(counts.rbegin(), counts.rend()));
    EXPECT_GT(counts.front(), counts.back());
    EXPECT_EQ(counts.back(), 1) << "one system is good enough for everything";
  }
}

TEST(GreedySegments, KeepToTheLongestLength) {
  const PlantedCorpus truth = planted(2, 6);
  const TextonFitter fitter(truth.corpus, three_states(Basis::kShared));
  for (const LabelledSegment& s : greedy_segments(truth.corpus, fitter, 1e6, 40, 100, {}))
    EXPECT_LT(s.length, 140) << "what is left of a run, shorter than a segment, joins the last";
}

TEST(InitialSegments, CanBeCancelled) {
  const PlantedCorpus truth = planted(2, 6);
  const TextonFitter fitter(truth.corpus, three_states(Basis::kShared));
  const std::atomic<bool> cancel{true};
  JobContext job;
  job.cancel = &cancel;
  EXPECT_THROW(greedy_segments(truth.corpus, fitter, 5, 40, 100, job), Cancelled);
  EXPECT_THROW(merged_segments(truth.corpus, fitter, 0, 40, job), Cancelled);
}

}  // namespace
}  // namespace motex
