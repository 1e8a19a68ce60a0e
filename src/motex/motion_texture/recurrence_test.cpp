// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/recurrence.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/motion_texture/learn.h"
#include "motex/motion_texture/recognition.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

TEST(Recurrence, KnownClipsAreNearTheirLabels) {
  const RecurrenceReport report = measure_recurrence(sample_model(), sample_clips());
  EXPECT_GT(report.num_segments, 8);
  EXPECT_GT(report.distance_to_random, 0);
  EXPECT_LT(report.distance_ratio(), 0.8);
  EXPECT_LE(report.distance_to_nearest, report.distance_to_label + 1e-9);
  EXPECT_GT(report.transitions_seen, 0.9) << "the clips were learned from";
  EXPECT_LE(report.transitions_chance, report.transitions_seen);
}

TEST(Recurrence, LikelihoodLeavesThePathsOut) {
  const RecurrenceReport report = measure_recurrence(sample_model(), sample_clips());
  const ScoreReport best = score_clips(sample_model(), sample_clips());
  EXPECT_LE(report.log_likelihood_per_frame, best.log_likelihood_per_frame + 1e-9)
      << "labels by moves cannot explain frames better than the best ones";
  EXPECT_NEAR(report.global_lds_log_likelihood_per_frame, best.global_lds_log_likelihood_per_frame, 1e-9);
}

TEST(Recurrence, PathsChangeWhatAClipIsCalledButNotItsDensity) {
  MotionTexture without = sample_model();
  without.options.path_weight = 0;
  EXPECT_EQ(score_clips(without, sample_clips()).log_likelihood_per_frame,
            score_clips(sample_model(), sample_clips()).log_likelihood_per_frame);
  MotionTexture strong = sample_model();
  strong.options.path_weight = 500;
  EXPECT_LE(measure_recurrence(strong, sample_clips()).distance_to_label,
            measure_recurrence(without, sample_clips()).distance_to_label + 1e-9);
}

TEST(Recurrence, RefusesWhatCannotBeMeasured) {
  EXPECT_THROW(measure_recurrence(sample_model(), {}), InvalidInput);
  const Clip brief = slice(sample_clips()[0], 0, 40);
  EXPECT_THROW(measure_recurrence(sample_model(), {&brief, 1}), InvalidInput);
}

}  // namespace
}  // namespace motex
