// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/motifs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/people/activity.h"

namespace motex {
namespace {

constexpr double kPi = std::numbers::pi;

/// Noise with two actions, each performed four times with its tempo and strength varied.
FrameMatrix planted(std::vector<std::vector<int>>& truth, std::uint64_t seed) {
  Rng rng(seed);
  FrameMatrix x(3200, 1);
  for (Index t = 0; t < x.rows(); ++t) x(t, 0) = 0.45 + 0.012 * rng.normal();
  truth.assign(2, {});
  for (int k = 0; k < 8; ++k) {
    const int length = static_cast<int>(std::lround(60 * rng.uniform(0.95, 1.05)));
    const int start = 100 + 380 * k + static_cast<int>(rng.below(60));
    truth[static_cast<std::size_t>(k % 2)].push_back(start);
    const double strength = rng.uniform(0.85, 1.15);
    for (int t = 0; t < length; ++t) {
      const double u = static_cast<double>(t) / (length - 1), bell = std::sin(kPi * u) * std::sin(kPi * u);
      x(start + t, 0) += strength * 0.3 * bell * (k % 2 == 0 ? std::sin(4 * kPi * u) : std::cos(2 * kPi * u));
    }
  }
  return x;
}

TEST(Motifs, OptionsOutOfRange) {
  FindMotifsOptions options;
  options.window = 3;
  EXPECT_THROW(find_motifs(FrameMatrix::Random(100, 1), options), InvalidInput);
  options.window = 101;
  EXPECT_THROW(find_motifs(FrameMatrix::Random(100, 1), options), InvalidInput);
}

TEST(Motifs, PlantedActionsAreFoundEachInOneMotif) {
  for (const int window : {0, 60}) {
    std::vector<std::vector<int>> truth;
    const FrameMatrix series = planted(truth, 5);
    FindMotifsOptions options;
    options.window = window;
    const MotifReport report = find_motifs(series, options);
    ASSERT_EQ(report.set.motifs.size(), 2U) << window;
    for (const Motif& motif : report.set.motifs) {
      ASSERT_EQ(motif.occurrences.size(), 4U);
      const bool is_first = std::abs(motif.occurrences[0].start - truth[0][0]) < 30;
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_LE(std::abs(motif.occurrences[k].start - truth[is_first ? 0 : 1][k]), 30);
    }
    EXPECT_GE(report.set.idle.size(), 7U);
  }
}

TEST(Motifs, WhoRestsOnlyBrieflyIsIdleThere) {
  Rng rng(5);
  constexpr int kAction = 45, kRest = 24, kTimes = 12;
  FrameMatrix x = FrameMatrix::Zero(kTimes * (kAction + kRest), 1);
  double sway = 0;
  for (Index t = 0; t < x.rows(); ++t) {
    x(t, 0) = 0.004 * (sway = 0.9 * sway + rng.normal());
    const auto in_action = static_cast<double>(t % (kAction + kRest));
    if (in_action < kAction) x(t, 0) += std::sin(2 * kPi * in_action / kAction);
  }
  const std::vector<FrameSpan> idle = find_activity(x, 24, 150, {}).idle;
  EXPECT_GE(idle.size(), 10U);
  for (const FrameSpan& span : idle)
    EXPECT_GE((span.start + span.length / 2) % (kAction + kRest), kAction) << span.start;
}

TEST(Motifs, WhatOnlyWandersRepeatsNothing) {
  Rng rng(3);
  FrameMatrix noise(2500, 1), walk(2500, 1), drift(2500, 1);
  double level = 0;
  for (Index t = 0; t < 2500; ++t) {
    noise(t, 0) = rng.normal();
    walk(t, 0) = level += rng.normal();
    drift(t, 0) = 0.001 * static_cast<double>(t) + 0.003 * rng.normal();
  }
  EXPECT_TRUE(find_motifs(noise).set.motifs.empty());
  EXPECT_TRUE(find_motifs(walk).set.motifs.empty());
  EXPECT_TRUE(find_motifs(drift).set.motifs.empty());
  const MotifReport still = find_motifs(FrameMatrix::Constant(500, 1, 2.5));
  EXPECT_TRUE(still.set.motifs.empty());
  ASSERT_EQ(still.set.idle.size(), 1U);
  EXPECT_EQ(still.set.idle[0], (FrameSpan{0, 500}));
}

TEST(Motifs, ASineIsOneThingThatRepeats) {
  FrameMatrix sine(2500, 1);
  for (Index t = 0; t < 2500; ++t) sine(t, 0) = std::sin(2 * kPi * static_cast<double>(t) / 41.3);
  const MotifReport report = find_motifs(sine);
  ASSERT_EQ(report.set.motifs.size(), 1U);
  EXPECT_GE(report.set.motifs[0].occurrences.size(), 50U);
}

TEST(Motifs, TheSameForAnyNumberOfThreads) {
  std::vector<std::vector<int>> truth;
  const FrameMatrix series = planted(truth, 6);
  JobContext one, three;
  one.jobs = 1;
  three.jobs = 3;
  const MotifSet a = find_motifs(series, {}, {}, one).set, b = find_motifs(series, {}, {}, three).set;
  ASSERT_EQ(a.motifs.size(), b.motifs.size());
  for (std::size_t k = 0; k < a.motifs.size(); ++k) {
    EXPECT_EQ(a.motifs[k].distance, b.motifs[k].distance);
    EXPECT_EQ(a.motifs[k].exemplar, b.motifs[k].exemplar);
  }
}

TEST(Motifs, CandidatesSayWhyTheyAreNone) {
  std::vector<std::vector<int>> truth;
  const FrameMatrix series = planted(truth, 5);
  FindMotifsOptions options;
  options.max_motifs = 1;
  const MotifReport report = find_motifs(series, options);
  ASSERT_EQ(report.set.motifs.size(), 1U);
  int num_over_k = 0;
  for (const MotifCandidate& candidate : report.candidates) {
    EXPECT_GE(candidate.starts.size(), 2U);
    const auto says = [&](const char* words) { return candidate.reason.find(words) != std::string::npos; };
    EXPECT_TRUE(says("more than K = 1") || says("overlaps occurrences of the motif at frame") ||
                says("not significant: ") || says("repeats within itself"))
        << candidate.reason;
    num_over_k += says("more than K = 1") ? 1 : 0;
  }
  EXPECT_GE(num_over_k, 1);
}

TEST(Motifs, Letters) {
  EXPECT_EQ(motif_letter(0), "A");
  EXPECT_EQ(motif_letter(25), "Z");
  EXPECT_EQ(motif_letter(26), "AA");
}

}  // namespace
}  // namespace motex
