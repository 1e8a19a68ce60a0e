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

}  // namespace
}  // namespace motex
