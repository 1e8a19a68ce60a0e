// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/pose_pictures.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "motex/core/error.h"
#include "motex/motion/stick_figure.h"
#include "motex/plot/colour.h"

namespace motex {
namespace {

Clip walk(Index frames) {
  StickFigureOptions options;
  options.num_frames = frames;
  Clip clip = walk_stick_figure(options).clip;
  clip.name = "walk";
  return clip;
}

template <typename S>
std::vector<S> shapes_of(const Drawing& drawing) {
  std::vector<S> out;
  for (const Shape& shape : drawing.shapes)
    if (const S* s = std::get_if<S>(&shape)) out.push_back(*s);
  return out;
}

/// Numbers written under the figures.
std::vector<int> frame_numbers(const Drawing& drawing) {
  std::vector<int> out;
  for (const Text& text : shapes_of<Text>(drawing))
    if (text.size == 10) out.push_back(std::stoi(text.text));
  return out;
}

TEST(PoseStrip, RejectsWhatCannotBeDrawn) {
  EXPECT_THROW(pose_strip(walk(0)), InvalidInput);
  PoseStripOptions options;
  options.start_secs = 100;
  EXPECT_THROW(pose_strip(walk(60), {}, options), InvalidInput);
  options = {};
  options.figures = 0;
  EXPECT_THROW(pose_strip(walk(60), {}, options), InvalidInput);
}

TEST(PoseStrip, FiguresStandAtEqualTimes) {
  PoseStripOptions options;
  options.figures = 5;
  options.secs = 4;
  options.start_secs = 1;
  EXPECT_EQ(frame_numbers(pose_strip(walk(600), {}, options)), (std::vector<int>{60, 120, 180, 240, 300}));
  options.rows = 2;
  EXPECT_EQ(frame_numbers(pose_strip(walk(600), {}, options)).size(), 10U);
}

TEST(PoseStrip, ShortClipsAreShownWhole) {
  EXPECT_EQ(frame_numbers(pose_strip(walk(25))).back(), 24);
  EXPECT_EQ(frame_numbers(pose_strip(walk(3))), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(frame_numbers(pose_strip(walk(1))), (std::vector<int>{0}));
}

TEST(PoseStrip, EveryFigureIsThereAndInsideThePicture) {
  PoseStripOptions options;
  options.figures = 6;
  const Image image = render(pose_strip(walk(600), {}, options));
  const int column = image.width / 6;
  for (int k = 0; k < 6; ++k) {
    int blue = 0, orange = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = k * column; x < (k + 1) * column; ++x) {
        const Rgba p = image.at(x, y);
        blue += p.b > p.r + 70 ? 1 : 0;
        orange += p.r > p.b + 90 && p.g > p.b + 30 ? 1 : 0;
      }
    EXPECT_GT(blue, 200) << k;
    EXPECT_GT(orange, 200) << k;
  }
  for (int x = 0; x < image.width; ++x) EXPECT_EQ(image.at(x, image.height - 1), (Rgba{255, 255, 255, 255}));
  for (int y = 0; y < image.height / 2; ++y) {
    EXPECT_EQ(image.at(0, y), (Rgba{255, 255, 255, 255}));
    EXPECT_EQ(image.at(image.width - 1, y), (Rgba{255, 255, 255, 255}));
  }
}

// The walk goes towards +Z and the view is turned towards the left side: the left shoulder is on the right of the
// picture.
TEST(PoseStrip, TheFigureFacesTheViewer) {
  PoseStripOptions options;
  options.figures = 1;
  options.azimuth_deg = 0;
  options.trails = false;
  const Image image = render(pose_strip(walk(60), {}, options));
  double blue_x = 0, orange_x = 0, blue = 0, orange = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Rgba p = image.at(x, y);
      if (p.b > p.r + 70) blue_x += x, ++blue;
      if (p.r > p.b + 90) orange_x += x, ++orange;
    }
  ASSERT_GT(blue, 0);
  ASSERT_GT(orange, 0);
  EXPECT_GT(blue_x / blue, orange_x / orange + 5);
}

TEST(PoseStrip, TrailsPassThroughHandAndFootAndCanBeLeftOut) {
  PoseStripOptions options;
  const auto num_lines = [&] { return shapes_of<Polyline>(pose_strip(walk(600), {}, options)).size(); };
  EXPECT_EQ(num_lines(), 4U);
  options.trails = false;
  EXPECT_EQ(num_lines(), 0U);
}

TEST(PoseStrip, TextonsLieUnderTheirFrames) {
  const std::vector<TextonSpan> spans{{3, 0, 100, ""}, {9, 100, 500, ""}};
  const Drawing drawing = pose_strip(walk(600), spans);
  std::vector<Polygon> boxes;
  for (const Polygon& polygon : shapes_of<Polygon>(drawing))
    if (polygon.fill.colour == unit_colour(3) || polygon.fill.colour == unit_colour(9)) boxes.push_back(polygon);
  ASSERT_EQ(boxes.size(), 2U);
  std::vector<double> figures;
  for (const Text& text : shapes_of<Text>(drawing))
    if (text.size == 10) figures.push_back(text.anchor.x);
  const double per_frame = (figures[1] - figures[0]) / 24;
  EXPECT_NEAR(boxes[1].points[0].x, figures[0] + 100 * per_frame, 0.1);
}

TEST(PoseStrip, SamePictureEveryTime) { EXPECT_EQ(to_svg(pose_strip(walk(300))), to_svg(pose_strip(walk(300)))); }

}  // namespace
}  // namespace motex
