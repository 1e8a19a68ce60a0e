// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/edit_list_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "motex/core/error.h"

namespace motex {
namespace {

using Json = nlohmann::json;

PeopleTexture texture() {
  PeopleTexture texture;
  texture.width = 64, texture.height = 48, texture.frames_per_sec = 25;
  for (int k = 0; k < 2; ++k) {
    Take& take = texture.takes.emplace_back();
    take.source = k == 0 ? "kata one.mp4" : "two.mov";
    take.source_start = k == 0 ? 10 : 0;
    take.mirrored = k == 1;
    take.frames = {100 * k, 100};
  }
  texture.silhouettes.resize(200);
  for (Silhouette& silhouette : texture.silhouettes) silhouette.box = {1, 1, 9, 9};
  Motif& motif = texture.alphabet.motifs.emplace_back();
  motif.letter = "A", motif.name = "high kick";
  return texture;
}

EditList film() {
  EditList edits;
  edits.shots = {{20, 49, 0}, {130, 169, -1}, {60, 79, -1}};
  edits.cuts = {{49, 130, 5, 9.25, 0.5}, {169, 60, 0, 3, 0.25}};
  edits.performances = {{0, 2, 25}, {-1, 40, 30}};
  return edits;
}

std::string message_of(const std::string& text) {
  try {
    parse_edit_list(text, "film.json", texture());
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(EditListJson, ReadsBackWhatItWrote) {
  const EditList written = film();
  const EditList read = parse_edit_list(edit_list_json(texture(), written), "film.json", texture());
  ASSERT_EQ(read.shots.size(), 3U);
  ASSERT_EQ(read.cuts.size(), 2U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(read.shots[k].first, written.shots[k].first);
    EXPECT_EQ(read.shots[k].last, written.shots[k].last);
    EXPECT_EQ(read.shots[k].motif, written.shots[k].motif);
  }
  EXPECT_EQ(read.cuts[0].transition_frames, 5);
  EXPECT_EQ(read.cuts[0].difference, 9.25);
  EXPECT_EQ(read.cuts[1].smoothness, 0.25);
  ASSERT_EQ(read.performances.size(), 2U);
  EXPECT_EQ(read.performances[1].motif, -1);
  EXPECT_EQ(read.performances[1].length, 30);
  EXPECT_EQ(edit_list_json(texture(), read), edit_list_json(texture(), written));
}

TEST(EditListJson, SaysWhereFramesComeFrom) {
  const Json root = Json::parse(edit_list_json(texture(), film()));
  EXPECT_EQ(root["frames"], 90);
  EXPECT_EQ(root["shots"][0]["source"], "kata one.mp4");
  EXPECT_EQ(root["shots"][0]["source_first"], 30);
  EXPECT_EQ(root["shots"][1]["source_first"], 30);
  EXPECT_EQ(root["shots"][1]["mirrored"], true);
  EXPECT_TRUE(root["shots"][1]["motif"].is_null());
}

TEST(EditListJson, ShotsWrittenByHandAreJoinedByHardCuts) {
  const EditList edits = parse_edit_list(R"({"shots": [{"first": 5, "last": 9, "motif": "high kick"}, {"first": 150,
      "last": 160}], "loop": true})",
                                         "film.json", texture());
  ASSERT_EQ(edits.cuts.size(), 2U);
  EXPECT_EQ(edits.cuts[1].from, 160);
  EXPECT_EQ(edits.cuts[1].to, 5);
  EXPECT_EQ(edits.shots[0].motif, 0);
}

TEST(EditListJson, NamesWhatIsWrong) {
  EXPECT_NE(message_of("no json").find("film.json: an edit list is"), std::string::npos);
  EXPECT_NE(message_of(R"({"shots": []})").find("no shot"), std::string::npos);
  EXPECT_NE(message_of(R"({"shots": [{"first": 5}]})").find("shots[0]: has no \"last\""), std::string::npos);
  EXPECT_NE(message_of(R"({"shots": [{"first": 5, "last": 200}]})").find("5 to 200"), std::string::npos);
  EXPECT_NE(message_of(R"({"shots": [{"first": 90, "last": 110}]})").find("film.json: "), std::string::npos);
  EXPECT_NE(message_of(R"({"shots": [{"first": 1, "last": 2, "motif": "Z"}]})").find("no motif"), std::string::npos);
  EXPECT_NE(message_of(R"({"shots": [{"first": 1.5, "last": 2}]})").find("whole"), std::string::npos);
  EXPECT_NE(
      message_of(R"({"shots": [{"first": 1, "last": 5}, {"first": 8, "last": 9}], "cuts": [{"from": 4, "to": 8}]})"),
      "");
}

/// Every object of the file, by schema.
void collect(const Json& json, std::map<std::string, std::vector<Json>>& found) {
  if (json.is_object() && json.contains("OTIO_SCHEMA")) found[json["OTIO_SCHEMA"]].push_back(json);
  if (json.is_structured())
    for (const Json& part : json) collect(part, found);
}

TEST(EditListOtio, IsATimelineOfClipsAndDissolves) {
  const Json root = Json::parse(edit_list_otio(texture(), film(), "film"));
  EXPECT_EQ(root["OTIO_SCHEMA"], "Timeline.1");
  EXPECT_EQ(root["tracks"]["OTIO_SCHEMA"], "Stack.1");
  const Json& track = root["tracks"]["children"][0];
  EXPECT_EQ(track["OTIO_SCHEMA"], "Track.1");
  EXPECT_EQ(track["kind"], "Video");
  ASSERT_EQ(track["children"].size(), 4U);
  const Json& clip = track["children"][0];
  EXPECT_EQ(clip["OTIO_SCHEMA"], "Clip.2");
  EXPECT_EQ(clip["name"], "high kick");
  EXPECT_EQ(clip["source_range"]["start_time"]["value"], 30);
  EXPECT_EQ(clip["source_range"]["duration"]["value"], 30);
  EXPECT_EQ(clip["source_range"]["duration"]["rate"], 25);
  EXPECT_EQ(clip["media_references"]["DEFAULT_MEDIA"]["target_url"], "kata%20one.mp4");
  const Json& transition = track["children"][1];
  EXPECT_EQ(transition["OTIO_SCHEMA"], "Transition.1");
  EXPECT_EQ(transition["in_offset"]["value"], 3);
  EXPECT_EQ(transition["out_offset"]["value"], 2);
  std::map<std::string, std::vector<Json>> found;
  collect(root, found);
  EXPECT_EQ(found["Clip.2"].size(), 3U);
  EXPECT_EQ(found["Effect.1"].size(), 1U) << "the mirrored shot";
  for (const Json& range : found["TimeRange.1"])
    for (const char* part : {"start_time", "duration"}) EXPECT_EQ(range[part]["OTIO_SCHEMA"], "RationalTime.1");
  for (const Json& c : found["Clip.2"]) {
    const Json& media = c["media_references"]["DEFAULT_MEDIA"];
    EXPECT_LE(
        c["source_range"]["start_time"]["value"].get<double>() + c["source_range"]["duration"]["value"].get<double>(),
        media["available_range"]["duration"]["value"].get<double>());
  }
}

}  // namespace
}  // namespace motex
