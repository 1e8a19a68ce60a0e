// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/motif_refine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "motex/core/rng.h"
#include "motex/people/motif_seeds.h"

namespace motex {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kLength = 50;  // of a performance

struct Score {
  FrameMatrix series;
  std::vector<FrameSpan> places;
};

/// Two signals that rest but for the actions written, each kLength frames: 'a', 'b' (another one), '.' (rest).
Score performed(const std::string& actions, std::uint64_t seed) {
  Rng rng(seed);
  Score out{FrameMatrix(kLength * static_cast<Index>(actions.size()), 2), {}};
  for (Index t = 0; t < out.series.rows(); ++t)
    for (Index s = 0; s < 2; ++s) out.series(t, s) = 0.01 * rng.normal();
  for (std::size_t k = 0; k < actions.size(); ++k) {
    const int start = kLength * static_cast<int>(k);
    if (actions[k] == '.') continue;
    const double strength = rng.uniform(0.9, 1.1), bent = rng.uniform(-0.1, 0.1);
    for (int t = 0; t < kLength; ++t) {
      const double u = (t + 0.5) / kLength, v = u + bent * u * (1 - u), bell = std::sin(kPi * v) * std::sin(kPi * v);
      const bool is_a = actions[k] == 'a';
      out.series(start + t, 0) += strength * bell * (is_a ? std::sin(3 * kPi * v) : std::cos(2 * kPi * v));
      out.series(start + t, 1) += strength * bell * (is_a ? std::cos(kPi * v) : std::sin(5 * kPi * v));
    }
    out.places.push_back({start, kLength});
  }
  return out;
}

Motif motif_at(int window, const std::vector<int>& starts) {
  Motif motif;
  motif.window = window;
  for (const int start : starts) motif.occurrences.push_back({start, window, 0.1});
  return motif;
}

std::vector<Motif> refined(const Score& score, std::vector<Motif> motifs, const std::vector<FrameSpan>& takes = {}) {
  const FindMotifsOptions options;
  const JobContext job;
  const auto num_frames = static_cast<std::size_t>(score.series.rows());
  MotifSearch search{score.series,
                     options,
                     takes,
                     job,
                     ActionWindows(std::vector<unsigned char>(num_frames, 1), 24),
                     PatternSearch(score.series, takes),
                     MotifCode(score.series, std::vector<double>(num_frames, 1), 24)};
  refine_motifs(search, {{0, static_cast<int>(num_frames)}}, motifs);
  return motifs;
}

/// Every place is an occurrence's but for `tolerance` frames, and no other is.
void expect_places(const Motif& motif, const std::vector<FrameSpan>& places, int tolerance) {
  ASSERT_EQ(motif.occurrences.size(), places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    EXPECT_NEAR(motif.occurrences[k].start, places[k].start, tolerance) << k;
    EXPECT_NEAR(motif.occurrences[k].start + motif.occurrences[k].length, places[k].end(), tolerance) << k;
  }
}

TEST(MotifRefine, APartGrowsToTheWholeAction) {
  const Score score = performed("..a..a...a..a..", 1);
  std::vector<int> starts;
  for (const FrameSpan& place : score.places) starts.push_back(place.start + 3);
  const std::vector<Motif> motifs = refined(score, {motif_at(28, starts)});
  ASSERT_EQ(motifs.size(), 1U);
  expect_places(motifs[0], score.places, 12);
}

TEST(MotifRefine, PairsBackToBackAreSinglePerformancesTheOddLastOneToo) {
  const Score score = performed(".aaaaaaaaa.", 2);
  const std::vector<Motif> motifs = refined(score, {motif_at(2 * kLength, {50, 150, 250, 350})});
  ASSERT_EQ(motifs.size(), 1U);
  expect_places(motifs[0], score.places, 12);
}

TEST(MotifRefine, AnotherActionIsNotGrownOver) {
  const Score score = performed("..ab.a..a..ab..a.", 3);
  std::vector<int> starts;
  std::vector<FrameSpan> own;
  for (const int place : {2, 5, 8, 11, 15}) own.push_back({place * kLength, kLength});
  for (const FrameSpan& span : own) starts.push_back(span.start + 4);
  const std::vector<Motif> motifs = refined(score, {motif_at(kLength - 8, starts)});
  ASSERT_EQ(motifs.size(), 1U);
  expect_places(motifs[0], own, 10);
}

TEST(MotifRefine, WhatTheEndsOfATakeCutOffIsGatheredWhenMostOfItIsSeen) {
  const Score score = performed(".a..a..a..a..a..a.", 4);
  const int last = score.places.back().start;
  const auto found = [&](int missing) {
    const FrameSpan take{kLength + missing, last - missing - missing};  // of the first and of the last performance
    std::vector<int> starts;
    for (std::size_t k = 1; k + 1 < score.places.size(); ++k) starts.push_back(score.places[k].start);
    const std::vector<Motif> motifs = refined(score, {motif_at(kLength, starts)}, {take});
    EXPECT_EQ(motifs.size(), 1U);
    if (motifs[0].occurrences.size() > 4) {
      EXPECT_EQ(motifs[0].occurrences.front().start, take.start);
      EXPECT_EQ(motifs[0].occurrences.back().start + motifs[0].occurrences.back().length, take.end());
    }
    return motifs[0].occurrences.size();
  };
  EXPECT_EQ(found(10), 6U);
  EXPECT_EQ(found(30), 4U);
}

TEST(MotifRefine, WhatIsCutOffIsNotInTheWayOfAnotherTake) {
  const Score score = performed("a..a..a.ab..b..b..b", 5);
  const FrameSpan first{0, 9 * kLength}, second{9 * kLength, 10 * kLength};
  Motif a = motif_at(kLength, {0, 3 * kLength, 6 * kLength});
  Motif b = motif_at(kLength + 20, {});  // begins 20 frames before the action does: the first one before its take
  for (const int place : {9, 12, 15, 18}) b.occurrences.push_back({place * kLength - 20, kLength + 20, 0.1});
  const std::vector<Motif> motifs = refined(score, {a, b}, {first, second});
  ASSERT_EQ(motifs.size(), 2U);
  for (const Motif& motif : motifs) EXPECT_EQ(motif.occurrences.size(), 4U);
}

TEST(MotifRefine, TwoPartsThatAreAlwaysPerformedTogetherAreOneAction) {
  const auto found = [](const std::string& actions) {
    std::vector<int> a, b;
    for (std::size_t k = 0; k < actions.size(); ++k)
      if (actions[k] != '.') (actions[k] == 'a' ? a : b).push_back(kLength * static_cast<int>(k));
    return refined(performed(actions, 6), {motif_at(kLength, a), motif_at(kLength, b)});
  };
  const std::vector<Motif> together = found(".ab...ab..ab....ab.");
  ASSERT_EQ(together.size(), 1U);
  expect_places(together[0], {{50, 100}, {300, 100}, {500, 100}, {800, 100}}, 10);
  EXPECT_EQ(found(".ab...a..b..ab....a..b.").size(), 2U);
}

}  // namespace
}  // namespace motex
