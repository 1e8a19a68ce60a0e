// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/paper_motifs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

FrameMatrix with_repetitions(Index num_frames) {
  Rng rng(2);
  FrameMatrix x(num_frames, 1);
  for (Index t = 0; t < num_frames; ++t) x(t, 0) = 0.1 * rng.normal();
  for (Index start = 20; start + 80 <= num_frames; start += 150)
    for (Index t = 0; t < 80; ++t)
      x(start + t, 0) += 3 * std::sin(std::numbers::pi * static_cast<double>(t * t) / 900.0);
  return x;
}

TEST(PaperMotifs, EveryLengthThatFitsTwice) {
  const PaperMotifReport report = find_paper_motifs(with_repetitions(300));
  ASSERT_EQ(report.searches.size(), 2U);
  EXPECT_EQ(report.searches[0].window, 40);
  EXPECT_EQ(report.searches[1].window, 80);
  EXPECT_EQ(report.searches[1].num_windows, 221);
  for (const PaperSearch& search : report.searches) EXPECT_GE(search.matrix_over_exact(), 1 - 1e-9);
  ASSERT_FALSE(report.set.motifs.empty());
  EXPECT_EQ(report.set.motifs[0].letter, "A");
  for (std::size_t k = 1; k < report.set.motifs.size(); ++k)
    EXPECT_LE(report.set.motifs[k].occurrences.size(), report.set.motifs[k - 1].occurrences.size());
}

TEST(PaperMotifs, OneLengthThatIsAskedFor) {
  FindMotifsOptions options;
  options.window = 60;
  const PaperMotifReport report = find_paper_motifs(with_repetitions(700), options);
  ASSERT_EQ(report.searches.size(), 1U);
  ASSERT_FALSE(report.set.motifs.empty());
  EXPECT_EQ(report.set.motifs[0].window, 60);
  EXPECT_GE(report.set.motifs[0].occurrences.size(), 4U);
}

TEST(PaperMotifs, BadSeries) {
  EXPECT_THROW(find_paper_motifs(with_repetitions(79)), InvalidInput);
  EXPECT_THROW(find_paper_motifs(FrameMatrix::Zero(500, 2)), InvalidInput);
}

TEST(PaperMotifs, WhatNeverMovesHasNoPair) {
  const PaperMotifReport report = find_paper_motifs(FrameMatrix::Zero(500, 1));
  EXPECT_TRUE(report.set.motifs.empty());
  for (const PaperSearch& search : report.searches) EXPECT_TRUE(std::isnan(search.matrix_over_exact()));
}

}  // namespace
}  // namespace motex
