// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/markers_io.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/motion_io/clip_io.h"

namespace motex {
namespace {

const std::string kFolder = std::string(MOTEX_TEST_DATA) + "/mocap/markers/";

TEST(HoldsMarkers, GoesByContentBeforeName) {
  const std::string c3d = read_file(kFolder + "made_intel_int.c3d");
  EXPECT_TRUE(holds_markers(c3d, "x.bvh"));
  EXPECT_TRUE(holds_markers("PathFileType\t4", "x.txt"));
  EXPECT_TRUE(holds_markers("", "x.c3d"));
  EXPECT_FALSE(holds_markers("HIERARCHY", "x.bvh"));
  EXPECT_FALSE(holds_markers("HIERARCHY", "x.c3d"));
  EXPECT_TRUE(holds_markers(std::filesystem::path(kFolder + "pc_int.c3d")));
  EXPECT_FALSE(holds_markers(std::filesystem::path(kFolder + "none.bvh")));
  EXPECT_FALSE(holds_markers(std::filesystem::path(kFolder)));
}

TEST(ReadMarkers, NoSkeletonCanBeReadFromThem) {
  for (const char* name : {"made_intel_int.c3d", "opensim_commas_8_frames.trc"}) {
    try {
      read_clip(kFolder + name);
      FAIL();
    } catch (const UnsupportedFile& error) {
      EXPECT_NE(std::string(error.what()).find("markers"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(read_markers_bytes("HIERARCHY", "x.bvh"), UnsupportedFile);
}

TEST(ReadMarkers, OptionsAreApplied) {
  ReadClipOptions options;
  options.fps = 100;
  options.skip_frames = 2;
  options.up = UpAxis::kZ;
  options.unit = LengthUnit::kInch;
  options.resample = 50;
  const MarkerSet markers = read_markers(kFolder + "made_sgi_real.c3d", options);
  ASSERT_EQ(markers.num_frames(), 2);
  EXPECT_DOUBLE_EQ(markers.frame_rate(), 50);
  EXPECT_DOUBLE_EQ(markers.metres_per_unit, 0.0254);
  // Marker 0 at frames 2 and 4 of the file, turned to y up: (x, z, −y).
  EXPECT_EQ(markers.position(0, 0), Vector3(2, 1000.5, -1));
  EXPECT_EQ(markers.position(1, 0), Vector3(4, 1001, -2));
  options.skip_frames = 6;
  EXPECT_THROW(read_markers(kFolder + "made_sgi_real.c3d", options), InvalidInput);
}

TEST(MarkerTables, HaveAColumnACoordinateAndEmptyCellsForGaps) {
  MarkerSet markers;
  markers.names = {"A", "B,C"};
  markers.frame_time_secs = 0.5;
  markers.positions.resize(2, 6);
  markers.positions << 1, 2, 3, 4, 5, 6, 7, 8, 9, NAN, NAN, NAN;
  EXPECT_EQ(write_csv_bytes(markers),
            "frame,time,A.X,A.Y,A.Z,\"B,C.X\",\"B,C.Y\",\"B,C.Z\"\n0,0,1,2,3,4,5,6\n1,0.5,7,8,9,,,\n");
  EXPECT_EQ(write_npz_bytes(markers).substr(0, 4), std::string("PK\x03\x04"));
  EXPECT_THROW(write_markers("x.bvh", markers), UnsupportedFile);
}

TEST(MetresOfUnitName, KnowsTheUsualOnes) {
  EXPECT_EQ(metres_of_unit_name("MM"), 0.001);
  EXPECT_EQ(metres_of_unit_name("meters"), 1);
  EXPECT_EQ(metres_of_unit_name("Inch"), 0.0254);
  EXPECT_EQ(metres_of_unit_name("parsec"), 0);
}

}  // namespace
}  // namespace motex
