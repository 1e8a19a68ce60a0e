// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/trackmate_xml.h"

#include <gtest/gtest.h>

namespace motex {
namespace {

int count(const std::string& text, const std::string& word) {
  int num = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++num;
  return num;
}

std::vector<Track> two_tracks() {
  return {{4, {{0, 1, 2, 1.5, 0.5, 40}, {1, 2, 4, 1.5, 0.5, -41}, {3, 4, 8, 1.5, 0.5, 42}, {4, 99, 9, 1.5, 0, 42}}},
          {7, {{3, 5, 6, 2, 0, 50}}}};
}

TrackedClip small_clip() {
  TrackedClip clip;
  clip.file_name = "a & <b>.mp4";
  clip.width = 20;
  clip.height = 10;
  clip.num_frames = 5;
  return clip;
}

TEST(TrackmateXml, HasSpotsByFrameEdgesAndVisibleTracks) {
  const std::string xml = trackmate_xml(two_tracks(), small_clip());
  EXPECT_EQ(count(xml, "<Spot "), 4) << "the point outside the picture is left out";
  EXPECT_EQ(count(xml, "nspots=\"4\""), 1);
  EXPECT_EQ(count(xml, "<SpotsInFrame "), 3);
  EXPECT_EQ(count(xml, "<Edge "), 2);
  EXPECT_EQ(count(xml, "<Track "), 1) << "a single point has no edge and so no track";
  EXPECT_EQ(count(xml, "<TrackID TRACK_ID=\"4\" />"), 1);
  EXPECT_EQ(count(xml, "NUMBER_GAPS=\"1\""), 1);
  EXPECT_EQ(count(xml, "SPOT_SOURCE_ID=\"1\" SPOT_TARGET_ID=\"2\""), 1);
  EXPECT_EQ(count(xml,
                  "QUALITY=\"41\" POSITION_T=\"1\" VISIBILITY=\"1\" FRAME=\"1\" RADIUS=\"2.12132\" "
                  "POSITION_X=\"2\" POSITION_Y=\"4\""),
            1);
  EXPECT_EQ(count(xml, "a &amp; &lt;b&gt;.mp4"), 1);
  EXPECT_EQ(count(xml, "<DisplaySettings />"), 1) << "without it TrackMate's reader says that an error occurred";
}

TEST(TrackmateXml, GivesPhysicalUnits) {
  TrackedClip clip = small_clip();
  clip.pixel_size = 0.5;
  clip.frame_interval = 0.04;
  clip.length_unit = "micron";
  clip.time_unit = "sec";
  const std::string xml = trackmate_xml(two_tracks(), clip);
  EXPECT_EQ(count(xml, "<Model spatialunits=\"micron\" timeunits=\"sec\">"), 1);
  EXPECT_EQ(count(xml, "POSITION_T=\"0.12\" VISIBILITY=\"1\" FRAME=\"3\" RADIUS=\"1.06066\" POSITION_X=\"2\""), 1);
  EXPECT_EQ(count(xml, "pixelwidth=\"0.5\""), 1);
  const std::string simple = trackmate_simple_xml(two_tracks(), clip);
  EXPECT_EQ(count(simple, "<particle nSpots=\"3\">"), 1);
  EXPECT_EQ(count(simple, "<particle nSpots=\"1\">"), 1);
  EXPECT_EQ(count(simple, "<detection t=\"3\" x=\"2\" y=\"4\" z=\"0\" />"), 1);
}

}  // namespace
}  // namespace motex
