// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/cable_tracks.h"

#include <gtest/gtest.h>

namespace motex {
namespace {

Base blob(double x, double y, double amplitude) {
  Base base;
  base.kind = BaseKind::kGaussian;
  base.x = x;
  base.y = y;
  base.scale = 1.5;
  base.angle = 0.25;
  base.coefficients.fill(static_cast<float>(coefficient_of_peak(base, amplitude)));
  return base;
}

TEST(CableTracks, GivesTheCoresWithTheirPeaks) {
  std::vector<Cable> cables(2);
  cables[0].first_frame = 4;
  cables[0].core = {blob(1, 2, 50), blob(1.5, 4, -60)};
  cables[1].core = {blob(7, 8, 90)};
  const std::vector<Track> tracks = tracks_of(cables, 3);
  ASSERT_EQ(tracks.size(), 2U);
  ASSERT_EQ(tracks[0].points.size(), 2U);
  EXPECT_EQ(tracks[1].id, 1);
  const TrackPoint& last = tracks[0].points[1];
  EXPECT_EQ(last.frame, 5);
  EXPECT_DOUBLE_EQ(last.x, 1.5);
  EXPECT_DOUBLE_EQ(last.y, 4);
  EXPECT_DOUBLE_EQ(last.scale, 1.5);
  EXPECT_DOUBLE_EQ(last.angle, 0.25);
  EXPECT_NEAR(last.amplitude, -60, 1e-3);
  EXPECT_NEAR(tracks[1].points[0].amplitude, 90, 1e-3);
}

TEST(CableTracks, ColourCountsAsItsLuma) {
  std::vector<Cable> cables(1);
  cables[0].core = {blob(7, 8, 100)};
  cables[0].core[0].coefficients[0] = 0;
  EXPECT_NEAR(tracks_of(cables, 3)[0].points[0].amplitude, 70.1, 1e-2);
  cables[0].core[0].coefficients[1] = 0;
  EXPECT_NEAR(tracks_of(cables, 1)[0].points[0].amplitude, 0, 1e-9);
}

}  // namespace
}  // namespace motex
