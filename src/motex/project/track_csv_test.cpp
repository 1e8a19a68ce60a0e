// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/track_csv.h"

#include <gtest/gtest.h>

#include "motex/core/error.h"

namespace motex {
namespace {

std::string complaint(const std::string& text) {
  try {
    parse_tracks_csv(text, "t.csv");
  } catch (const ParseError& error) {
    return error.what();
  }
  return "";
}

TEST(TrackCsv, SaysWhatIsWrongAndWhere) {
  EXPECT_NE(complaint("").find("no column"), std::string::npos);
  EXPECT_NE(complaint("frame,x,y\n1,2,3\n").find("'track'"), std::string::npos);
  EXPECT_NE(complaint("frame,id,x,y\n0,0,1,1\n1,0,oops,1\n").find("t.csv:3: 'oops'"), std::string::npos);
  EXPECT_NE(complaint("frame,id,x,y\n0,0,1\n").find("t.csv:2: the line has too few"), std::string::npos);
  EXPECT_NE(complaint("frame,id,x,y\n0.5,0,1,1\n").find("whole number"), std::string::npos);
  EXPECT_NE(complaint("frame,id,x,y\n0,0,1,nan\n").find("not a number"), std::string::npos);
  EXPECT_NE(complaint("frame,id,x,y\n0,4,1,1\n0,4,2,2\n").find("track 4 stands twice"), std::string::npos);
}

TEST(TrackCsv, ColumnsInAnyOrder) {
  const std::vector<Track> tracks = parse_tracks_csv(
      "\xEF\xBB\xBFy;Frame;TRACK;x;note;amp\r\n2.5;1;7;10;a;80\r\n\r\n2;0;7;9;b;0\n5;3;-2;1;;1", "t.csv");
  ASSERT_EQ(tracks.size(), 2U);
  EXPECT_EQ(tracks[0].id, -2);
  ASSERT_EQ(tracks[1].points.size(), 2U);
  EXPECT_EQ(tracks[1].points[0].frame, 0) << "sorted by frame";
  EXPECT_EQ(tracks[1].points[0].amplitude, 0);
  EXPECT_EQ(tracks[1].points[1].y, 2.5);
}

TEST(TrackCsv, WritesWhatItReadsAndOnlyWhatIsInThePicture) {
  std::vector<Track> tracks(2);
  tracks[0] = {3, {{0, 1.25, 2.5, 1.5, 0.1, 80}, {1, -0.6, 2, 1, 0, 80}, {2, 9.49, -0.5, 1, -0.00001, -20.125}}};
  tracks[1] = {12, {{7, 9.5, 2, 1, 0, 80}, {8, 4, 5.5, 1, 0, 80}}};
  const std::string text = tracks_csv(tracks, 10, 6);
  EXPECT_EQ(text, "track,frame,x,y,scale,angle,amplitude\n3,0,1.25,2.5,1.5,0.1,80\n3,2,9.49,-0.5,1,0,-20.125\n");
  const std::vector<Track> back = parse_tracks_csv(text, "t.csv");
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(back[0].points[1].amplitude, -20.125);
  EXPECT_EQ(back[0].points[0].scale, 1.5);
  EXPECT_EQ(tracks_csv({}, 10, 6), TrackCsv::heading());
}

TEST(TrackCsv, DetectionsNeedNoTrack) {
  const std::vector<TrackPoint> points = parse_points_csv("y;frame;x;true_id\n1;0;2;5\n\n# x\n3;1;4;x\n", "d.csv");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[1].frame, 1);
  EXPECT_EQ(points[1].x, 4);
  EXPECT_EQ(points[1].y, 3);
  EXPECT_THROW(parse_points_csv("x,y\n1,2\n", "d.csv"), ParseError);
}

}  // namespace
}  // namespace motex
