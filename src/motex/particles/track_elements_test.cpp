// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/track_elements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/rng.h"
#include "motex/particles/cable_tracks.h"
#include "motex/particles/fit_dynamics.h"
#include "motex/particles/simulate.h"
#include "motex/particles/track_score.h"

namespace motex {
namespace {

struct Snow {
  ClipFrames clip;
  Plane background;
  std::vector<Track> truth;
};

/// Gaussian flakes that fall with the wind past a textured background.
Snow snowfall(int per_frame, int num_frames, std::uint64_t seed) {
  constexpr int kWidth = 128, kHeight = 96;
  Rng rng(seed);
  Snow snow;
  snow.clip.width = kWidth;
  snow.clip.height = kHeight;
  snow.background = Plane(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      snow.background.at(x, y) = static_cast<float>(70 + 20 * std::sin(0.1 * x) * std::cos(0.13 * y));
  for (int t = 0; t < num_frames; ++t) {
    snow.clip.luma.push_back(snow.background);
    for (float& value : snow.clip.luma.back().values) value += static_cast<float>(4 * rng.normal());
  }
  const int num = per_frame * (kWidth + 60) * (kHeight + 3 * num_frames + 20) / (kWidth * kHeight);
  for (int k = 0; k < num; ++k) {
    double x = rng.uniform(-30, kWidth + 30), y = rng.uniform(-3.0 * num_frames - 10, kHeight + 10);
    double vx = 0.8 + 0.35 * rng.normal(), vy = 3 + 0.35 * rng.normal();
    const double scale = rng.uniform(1, 2.2), amplitude = rng.uniform(50, 110);
    Track track;
    track.id = k;
    for (int t = 0; t < num_frames; ++t) {
      Base flake{BaseKind::kGaussian, x, y, scale, 0, {}};
      add_patch(snow.clip.luma[static_cast<std::size_t>(t)], render_patch(flake, kWidth, kHeight),
                static_cast<float>(coefficient_of_peak(flake, amplitude)));
      track.points.push_back({t, x, y, scale, 0, amplitude});
      vx = 0.8 + 0.7 * (vx - 0.8) + 0.25 * rng.normal();
      vy = 3 + 0.7 * (vy - 3) + 0.25 * rng.normal();
      x += vx;
      y += vy;
    }
    snow.truth.push_back(track);
  }
  snow.truth = visible_part(snow.truth, kWidth, kHeight);
  return snow;
}

TEST(TrackElements, RefusesWhatItCannotUse) {
  Snow snow = snowfall(5, 4, 1);
  EXPECT_THROW(track_elements({}, snow.background, 0, {}), InvalidInput);
  EXPECT_THROW(track_elements(snow.clip, Plane(3, 3), 0, {}), InvalidInput);
  std::atomic<bool> stop{true};
  JobContext job;
  job.cancel = &stop;
  EXPECT_THROW(track_elements(snow.clip, snow.background, 0, {}, job), Cancelled);
}

TEST(TrackElements, SnowIsTrackedAndItsNoiseAndDynamicsFound) {
  const Snow snow = snowfall(45, 20, 2);
  TrackElementsReport report;
  const std::vector<Cable> cables = track_elements(snow.clip, snow.background, 0, {}, {}, &report);
  const TrackingScore score = score_tracks(snow.truth, visible_part(tracks_of(cables, 1), 128, 96));
  EXPECT_GT(score.beta, 0.9);
  EXPECT_GT(score.jsc_tracks, 0.88);
  EXPECT_LT(score.rmse, 0.3);
  EXPECT_NEAR(report.noise, 4, 0.3);
  EXPECT_NEAR(report.link.flow.flow.vy, 3, 0.3);
  EXPECT_EQ(report.detect.sign, CoreSign::kBright);
  for (const Cable& cable : cables)
    for (const Base& core : cable.core) EXPECT_EQ(core.kind, BaseKind::kGaussian);
}

TEST(TrackElements, PlacesAsSeenKeepTheDynamicsThatSmoothingChanges) {
  const Snow snow = snowfall(45, 60, 3);  // persistence 0.7, deviation 0.25
  TrackElementsReport report;
  const std::vector<Cable> cables = track_elements(snow.clip, snow.background, 0, {}, {}, &report);
  ASSERT_EQ(report.seen.size(), cables.size());
  FitDynamicsOptions options;
  options.estimate_errors = true;
  for (const CoordinateDynamics& axis : {fit_dynamics(report.seen, options).x, fit_dynamics(report.seen, options).y}) {
    EXPECT_NEAR(axis.persistence(), 0.7, 0.05);
    EXPECT_NEAR(axis.d, 0.25, 0.02);
  }
}

TEST(TrackElements, TheSecondRoundTellsMoreOfThemApart) {
  const Snow snow = snowfall(60, 24, 6);
  const auto beta_of = [&](int rounds) {
    TrackElementsOptions options;
    options.rounds = rounds;
    return score_tracks(snow.truth,
                        visible_part(tracks_of(track_elements(snow.clip, snow.background, 0, options), 1), 128, 96))
        .beta;
  };
  EXPECT_GT(beta_of(2), beta_of(1) + 0.005);
}

TEST(TrackElements, AWrongBackgroundIsMended) {
  Snow snow = snowfall(20, 16, 4);
  Plane wrong = snow.background;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 128; ++x) wrong.at(x, y) += 6;
  TrackElementsReport report;
  track_elements(snow.clip, wrong, 0, {}, {}, &report);
  double error = 0;
  for (std::size_t i = 0; i < wrong.values.size(); ++i)
    error += std::abs(static_cast<double>(report.background.values[i] - snow.background.values[i]));
  EXPECT_LT(error / static_cast<double>(wrong.values.size()), 1.5);
}

TEST(TrackElements, EachFrameIsSeenBeforeItsOwnBackground) {
  Snow snow = snowfall(20, 16, 4);
  for (int t = 0; t < snow.clip.num_frames(); ++t)  // light that goes by
    for (int y = 0; y < 96; ++y)
      for (int x = 0; x < 128; ++x)
        snow.clip.luma[static_cast<std::size_t>(t)].at(x, y) +=
            static_cast<float>(80 + 80 * std::sin((x + 15 * t) / 30.0));
  const ClipBackground background(snow.clip, BackgroundKind::kSmooth, {});
  const std::vector<Cable> cables = track_elements(snow.clip, background, {});
  std::vector<Plane> left = background.residuals();
  subtract_cables(left, cables, 1);
  EXPECT_GT(psnr_of(left), psnr_of(background.residuals()) + 2);
  EXPECT_GT(score_tracks(snow.truth, visible_part(tracks_of(cables, 1), 128, 96)).beta, 0.5);
}

TEST(TrackElements, SparksOfABurstBeginTogether) {
  SimulateFireworksOptions options;
  options.width = 160;
  options.height = 120;
  options.frames = 44;
  options.bursts = 1;
  options.elements = 30;
  options.speed = 1.7;
  const SimulatedScene scene = simulate_fireworks(options);
  const ClipFrames clip = clip_frames_of(scene);
  const std::vector<Cable> cables = track_elements(clip, Plane(160, 120, 8.0F), 0, {});
  const TrackingScore score =
      score_tracks(tracks_of(true_cables(scene), clip.num_planes()), visible_part(tracks_of(cables, 1), 160, 120));
  EXPECT_GT(score.beta, 0.85);
  EXPECT_GT(score.jsc_tracks, 0.85);
  const auto born = static_cast<std::int64_t>(std::ceil(scene.bursts[0].frame));
  const auto num_on_time = std::count_if(cables.begin(), cables.end(),
                                         [&](const Cable& cable) { return std::abs(cable.first_frame - born) <= 1; });
  EXPECT_GT(num_on_time, 0.8 * static_cast<double>(cables.size()));
}

TEST(TrackElements, TheNumberOfThreadsChangesNothing) {
  const Snow snow = snowfall(30, 10, 5);
  const auto run = [&](int jobs) {
    JobContext job;
    job.jobs = jobs;
    std::vector<double> numbers;
    for (const Cable& cable : track_elements(snow.clip, snow.background, 0, {}, job))
      for (const Base& core : cable.core)
        numbers.insert(numbers.end(), {core.x, core.y, core.scale, static_cast<double>(core.coefficients[0])});
    return numbers;
  };
  const std::vector<double> one = run(1);
  EXPECT_FALSE(one.empty());
  EXPECT_EQ(one, run(3));
}

}  // namespace
}  // namespace motex
