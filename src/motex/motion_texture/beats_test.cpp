// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/beats.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

std::vector<double> steady(double bpm, double secs) {
  std::vector<double> beats;
  for (int i = 0; 0.2 + 60 * i / bpm < secs; ++i) beats.push_back(0.2 + 60 * i / bpm);
  return beats;
}

TEST(Beats, BadBeats) {
  const std::vector<std::vector<int>> followers(sample_model().instances.size());
  for (const std::vector<double>& beats :
       {std::vector<double>{}, {1, 1}, {2, 1}, {-1, 1}, {1e7}, std::vector<double>(30000, 1)})
    EXPECT_THROW(BeatGrid(sample_model(), beats, 0.15, followers), InvalidInput);
}

TEST(Beats, TextonsBeginOnBeats) {
  for (const double bpm : {60.0, 97.0, 120.0, 190.0})
    for (const std::uint64_t seed : {1U, 2U}) {
      SynthesizeOptions options;
      options.seed = seed;
      options.beats = steady(bpm, 45);
      SynthesizeReport report;
      synthesize_motion(sample_model(), 2400, {}, options, report);
      const BeatReport beats = report_beats(sample_model(), report.played, options.beats);
      EXPECT_GE(beats.num_boundaries, 10);
      EXPECT_LE(beats.median_offset, 1) << bpm;
      EXPECT_GE(beats.share_on_beat, 0.95) << bpm;
      EXPECT_LE(beats.median_stretch, 1.2) << bpm;
    }
}

TEST(Beats, WithoutThemFewBegin) {
  SynthesizeOptions options;
  SynthesizeReport report;
  synthesize_motion(sample_model(), 2400, {}, options, report);
  EXPECT_LE(report_beats(sample_model(), report.played, steady(97, 45)).share_on_beat, 0.4);
}

TEST(Beats, AfterTheLastBeatExamplesKeepTheirLength) {
  SynthesizeOptions options;
  options.beats = {0.5, 1.0};
  SynthesizeReport report;
  synthesize_motion(sample_model(), 1200, {}, options, report);
  const MotionTexture& model = sample_model();
  for (std::size_t k = 2; k + 1 < report.played.size(); ++k) {
    const Instance& instance = model.instances[static_cast<std::size_t>(report.played[k].instance)];
    EXPECT_LE(std::abs(report.played[k].length - instance.length), 2) << k;
  }
}

}  // namespace
}  // namespace motex
