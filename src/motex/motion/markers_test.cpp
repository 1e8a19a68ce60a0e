// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/markers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Two rigid triangles (markers 0–2 and 3–5) that turn about y in opposite directions and part, and a stray point.
MarkerSet two_triangles(Index num_frames) {
  MarkerSet markers;
  markers.name = "two";
  markers.names = {"LA", "LB", "LC", "RA", "RB", "RC", "stray"};
  markers.frame_time_secs = 0.01;
  markers.positions.resize(num_frames, 21);
  const Vector3 corners[] = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  for (Index t = 0; t < num_frames; ++t) {
    const double turn = 0.05 * static_cast<double>(t);
    for (int m = 0; m < 6; ++m) {
      const Eigen::AngleAxisd rotation(m < 3 ? turn : -turn, Vector3::UnitY());
      markers.set_position(t, m, rotation * corners[m % 3] + Vector3(m < 3 ? 0 : 10 + static_cast<double>(t), 5, 0));
    }
    markers.set_position(t, 6, Vector3(20 * std::sin(3 * turn), 30, 1));
  }
  return markers;
}

TEST(CheckMarkers, RefusesWhatDoesNotFit) {
  MarkerSet markers = two_triangles(4);
  EXPECT_NO_THROW(check_markers(markers));
  markers.set_position(1, 2, Vector3::Constant(kNaN));
  EXPECT_NO_THROW(check_markers(markers));
  markers.positions(1, 7) = 3;
  EXPECT_THROW(check_markers(markers), InvalidInput);
  markers = two_triangles(4);
  markers.names[1] = "LA";
  EXPECT_THROW(check_markers(markers), InvalidInput);
  markers = two_triangles(4);
  markers.names.pop_back();
  EXPECT_THROW(check_markers(markers), InvalidInput);
  markers = two_triangles(4);
  markers.frame_time_secs = 0;
  EXPECT_THROW(check_markers(markers), InvalidInput);
}

TEST(DistinctMarkerNames, KeepsStatedNamesAndMakesOthersUp) {
  const std::vector<std::string> names = distinct_marker_names({"A", "", "A", "A_2", "A", ""});
  EXPECT_EQ(names, (std::vector<std::string>{"A", "marker1", "A_3", "A_2", "A_4", "marker5"}));
}

TEST(SliceMarkers, TakesFramesAndRefusesOthers) {
  const MarkerSet markers = two_triangles(10), part = slice(markers, 3, 4);
  EXPECT_EQ(part.num_frames(), 4);
  EXPECT_EQ(part.positions.row(0), markers.positions.row(3));
  EXPECT_THROW(slice(markers, 8, 3), InvalidInput);
  EXPECT_THROW(slice(markers, -1, 3), InvalidInput);
}

TEST(ResampleMarkers, IsLinearAndKeepsGapsNarrow) {
  MarkerSet markers = two_triangles(5);
  for (Index t = 0; t < 5; ++t) markers.set_position(t, 0, Vector3(static_cast<double>(t), 0, 0));
  markers.set_position(2, 0, Vector3::Constant(kNaN));
  const MarkerSet twice = resample(markers, 0.005);
  ASSERT_EQ(twice.num_frames(), 9);
  EXPECT_DOUBLE_EQ(twice.position(1, 0).x(), 0.5);
  EXPECT_TRUE(twice.seen(2, 0));
  EXPECT_FALSE(twice.seen(3, 0));
  EXPECT_FALSE(twice.seen(4, 0));
  EXPECT_FALSE(twice.seen(5, 0));
  EXPECT_TRUE(twice.seen(6, 0));
  const MarkerSet same = resample(twice, 0.01);
  EXPECT_TRUE(same.seen(1, 0));
  EXPECT_EQ(same.num_frames(), 5);
}

TEST(PickMarkers, TakesThemInTheOrderAskedFor) {
  const MarkerSet markers = two_triangles(3), picked = pick_markers(markers, {"RC", "LA"});
  EXPECT_EQ(picked.position(1, 0), markers.position(1, 5));
  EXPECT_EQ(picked.position(1, 1), markers.position(1, 0));
  EXPECT_THROW(pick_markers(markers, {"nobody"}), InvalidInput);
}

TEST(RigidPairs, FindsThePartsAndNothingBetweenThem) {
  const auto pairs = rigid_pairs(two_triangles(120));
  // The longest side of each triangle is left out: its third corner lies nearer to both of its ends.
  EXPECT_EQ(pairs, (std::vector<std::pair<int, int>>{{0, 1}, {0, 2}, {3, 4}, {3, 5}}));
}

TEST(MissingShare, CountsPerMarkerAndOverAll) {
  MarkerSet markers = two_triangles(10);
  for (Index t = 0; t < 5; ++t) markers.set_position(t, 6, Vector3::Constant(kNaN));
  EXPECT_DOUBLE_EQ(missing_share(markers, 6), 0.5);
  EXPECT_DOUBLE_EQ(missing_share(markers, 0), 0);
  EXPECT_NEAR(missing_share(markers), 0.5 / 7, 1e-15);
}

TEST(LooksZUp, TellsTheLongAxis) {
  MarkerSet markers;
  markers.positions.resize(3, 36);
  for (int m = 0; m < 12; ++m) {
    markers.names.push_back("m" + std::to_string(m));
    for (Index t = 0; t < 3; ++t) markers.set_position(t, m, Vector3(m % 3, m % 2, 10 * m));
  }
  EXPECT_TRUE(looks_z_up(markers));
  for (int m = 0; m < 12; ++m)
    for (Index t = 0; t < 3; ++t) markers.set_position(t, m, Vector3(m % 3, 10 * m, m % 2));
  EXPECT_FALSE(looks_z_up(markers));
}

}  // namespace
}  // namespace motex
