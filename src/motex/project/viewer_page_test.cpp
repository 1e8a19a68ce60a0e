// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/viewer_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "motex/core/error.h"
#include "motex/motion/stick_figure.h"
#include "motex/project/figure.h"

namespace motex {
namespace {

Clip walk(Index frames) {
  StickFigureOptions options;
  options.num_frames = frames;
  Clip clip = walk_stick_figure(options).clip;
  clip.name = "walk";
  return clip;
}

nlohmann::json data_of(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"motex-data\">";
  const std::size_t start = page.find(open) + open.size();
  return nlohmann::json::parse(page.substr(start, page.find("</script", start) - start));
}

int value_of(char c) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  return static_cast<int>(digits.find(c));
}

/// The first `count` 16-bit numbers of base64 text.
std::vector<int> decode_u16(const std::string& base64, std::size_t count) {
  std::vector<int> bytes, out;
  for (std::size_t i = 0; i + 3 < base64.size() && bytes.size() < 2 * count; i += 4) {
    const int group = value_of(base64[i]) << 18 | value_of(base64[i + 1]) << 12 | value_of(base64[i + 2]) << 6 |
                      value_of(base64[i + 3]);
    for (const int shift : {16, 8, 0}) bytes.push_back(group >> shift & 255);
  }
  for (std::size_t i = 0; i < count; ++i) out.push_back(bytes[2 * i] | bytes[2 * i + 1] << 8);
  return out;
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(ViewerPage, RejectsEmptyClipsAndSpansOutside) {
  EXPECT_THROW(viewer_page(walk(0)), InvalidInput);
  for (const TextonSpan& span : {TextonSpan{0, -1, 5, ""}, TextonSpan{0, 8, 5, ""}, TextonSpan{0, 0, -2, ""}})
    EXPECT_THROW(viewer_page(walk(10), {span}), InvalidInput);
}

TEST(ViewerPage, PositionsComeBackWithinATenthOfAMillimetre) {
  const Clip clip = walk(300);
  const auto data = data_of(viewer_page(clip));
  const Figure figure = make_figure(clip.skeleton);
  const FrameMatrix points = figure_points(figure, clip);
  const double floor = floor_height(points);
  ASSERT_EQ(data["numFrames"], 300);
  ASSERT_EQ(data["numPoints"], figure.num_points);
  const auto quanta = decode_u16(data["points"], static_cast<std::size_t>(points.size()));
  for (Index i = 0; i < points.size(); ++i) {
    const double expected = points.data()[i] - (i % 3 == 1 ? floor : 0);
    const double decoded = data["origin"][static_cast<std::size_t>(i % 3)].get<double>() +
                           data["step"].get<double>() * quanta[static_cast<std::size_t>(i)];
    ASSERT_NEAR(decoded, expected, 0.01) << i;  // centimetres
  }
}

TEST(ViewerPage, NamesCannotLeaveTheirPlace) {
  Clip clip = walk(10);
  const std::string plain = viewer_page(clip, {{1, 0, 10, "source"}});
  const std::string evil = "</script><script>alert(1)</script><!-- @DATA@ @SCRIPT@ & \"quotes\" \xff";
  clip.name = evil;
  const std::string page = viewer_page(clip, {{1, 0, 10, evil}});
  EXPECT_EQ(occurrences(page, "</script"), occurrences(plain, "</script"));
  EXPECT_EQ(occurrences(page, "<!--"), occurrences(plain, "<!--"));
  EXPECT_EQ(occurrences(page, "</title"), 1U);
  const auto data = data_of(page);
  EXPECT_EQ(data["name"].get<std::string>().substr(0, 40), evil.substr(0, 40));
  EXPECT_EQ(data["spans"][0]["source"].get<std::string>().substr(0, 40), evil.substr(0, 40));
}

TEST(ViewerPage, NeedsNoNetwork) {
  const std::string page = viewer_page(walk(10));
  for (const char* part : {"http://", "https://", "import(", "fetch(", " src=", "@import"})
    EXPECT_EQ(page.find(part), std::string::npos) << part;
  for (const char* mark : {"@TITLE@", "@STYLE@", "@DATA@", "@SCRIPT@"}) EXPECT_EQ(page.find(mark), std::string::npos);
}

TEST(ViewerPage, AMinuteOfDanceIsSmall) { EXPECT_LT(viewer_page(walk(3600)).size(), 2'000'000U); }

TEST(ViewerPage, SpansTrailsAndFrontAreInTheData) {
  const Clip clip = walk(100);
  const auto data = data_of(viewer_page(clip, {{7, 10, 90, "walk, frames 0–89"}}));
  EXPECT_EQ(data["spans"][0]["texton"], 7);
  EXPECT_EQ(data["spans"][0]["colour"].get<std::string>().size(), 7U);
  EXPECT_EQ(data["trails"].size(), 4U);
  EXPECT_EQ(data["trailSides"], (std::vector<int>{1, 2, 1, 2}));
  EXPECT_EQ(data["centre"].size(), 2U);
  EXPECT_NEAR(data["frontYaw"].get<double>(), 0, 0.4);
}

TEST(ViewerPage, SamePageEveryTime) { EXPECT_EQ(viewer_page(walk(50)), viewer_page(walk(50))); }

}  // namespace
}  // namespace motex
