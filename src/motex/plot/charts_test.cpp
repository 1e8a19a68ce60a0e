// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/plot/charts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "motex/core/error.h"
#include "motex/plot/colour.h"

namespace motex {
namespace {

std::vector<std::string> texts(const Scale& scale) {
  std::vector<std::string> out;
  for (const Tick& tick : scale.ticks) out.push_back(tick.text);
  return out;
}

template <typename S>
std::vector<S> shapes_of(const Drawing& drawing) {
  std::vector<S> out;
  for (const Shape& shape : drawing.shapes)
    if (const S* s = std::get_if<S>(&shape)) out.push_back(*s);
  return out;
}

bool has_text(const Drawing& drawing, const std::string& wanted) {
  for (const Text& text : shapes_of<Text>(drawing))
    if (text.text == wanted) return true;
  return false;
}

TEST(Charts, RejectWhatCannotBeShown) {
  LinePlot plot;
  plot.series = {{"a", {1, 2}, {1}, Mark::kLine, {}}};
  EXPECT_THROW(draw(plot), InvalidInput);
  plot.series = {{"a", {1, 2}, {1, 2}, Mark::kLine, {}}};
  plot.size = {40, 30};
  EXPECT_THROW(draw(plot), InvalidInput);
  EXPECT_THROW(draw(HeatMap{}), InvalidInput);
  EXPECT_THROW(draw(StripPlot{}), InvalidInput);
  EXPECT_THROW(draw_segments({}, 1, 1, 100, 10), InvalidInput);
  EXPECT_THROW(grid({}, 2, ""), InvalidInput);
}

TEST(Scale, TicksAreRoundNumbers) {
  EXPECT_EQ(texts(make_scale({}, 0.3, 9.7, 5)), (std::vector<std::string>{"0", "2", "4", "6", "8", "10"}));
  EXPECT_EQ(texts(make_scale({}, -0.11, 0.13, 5)),
            (std::vector<std::string>{"-0.15", "-0.10", "-0.05", "0", "0.05", "0.10", "0.15"}));
  EXPECT_EQ(texts(make_scale({"", true, {}, {}}, 1, 1000, 6)), (std::vector<std::string>{"1", "10", "100", "1000"}));
  EXPECT_EQ(texts(make_scale({"", true, {}, {}}, 1, 50, 6)),
            (std::vector<std::string>{"1", "2", "5", "10", "20", "50"}));
  EXPECT_EQ(texts(make_scale({"", false, 0, 3e6}, 0, 3e6, 3)).back(), "3e+06");
}

TEST(Scale, NoOrOneValueStillMakesAScale) {
  for (const bool log : {false, true}) {
    const Axis axis{"", log, {}, {}};
    for (const Scale& scale :
         {make_scale(axis, INFINITY, -INFINITY, 5), make_scale(axis, 7, 7, 5), make_scale(axis, 0, 0, 5)}) {
      EXPECT_LT(scale.min, scale.max);
      EXPECT_GE(scale.ticks.size(), 1U);
    }
  }
}

TEST(Scale, PlaceIsLinearOrLogarithmic) {
  EXPECT_DOUBLE_EQ((Scale{2, 6, false, {}}.place(3)), 0.25);
  EXPECT_NEAR((Scale{1, 1000, true, {}}.place(10)), 1.0 / 3, 1e-12);
}

TEST(LinePlotDrawing, LinesBreakAtMissingValuesAndStayInside) {
  LinePlot plot;
  plot.title = "likelihood";
  plot.y_axis = {"nats", false, 0.0, 10.0};
  plot.series = {{"own", {0, 1, 2, 3, 4, 5}, {1, 2, NAN, 3, 40, 5}, Mark::kLine, Rgba{1, 2, 3, 255}}};
  const Drawing drawing = draw(plot);
  int pieces = 0;
  for (const Polyline& line : shapes_of<Polyline>(drawing)) {
    if (!(line.colour == Rgba{1, 2, 3, 255}) || line.points.size() < 2) continue;
    ++pieces;
    for (const Point& p : line.points) EXPECT_GE(p.y, 30) << "above the frame";
  }
  EXPECT_EQ(pieces, 1 + 1 + 2);  // legend, 0…1, up to the top edge and down again
  EXPECT_TRUE(has_text(drawing, "likelihood"));
  EXPECT_TRUE(has_text(drawing, "nats"));
  EXPECT_TRUE(has_text(drawing, "own"));
}

TEST(LinePlotDrawing, LogarithmicAxesLeaveOutWhatIsNotPositive) {
  LinePlot plot;
  plot.x_axis.log = true;
  plot.series = {{"", {0, 1, 10, 100}, {1, 2, 3, 4}, Mark::kPoints, {}}};
  EXPECT_EQ(shapes_of<Disc>(draw(plot)).size(), 3U);
}

TEST(LinePlotDrawing, AnEmptyPlotIsDrawn) { EXPECT_NO_THROW(render(draw(LinePlot{}))); }

TEST(HeatMapDrawing, CellsCarryTheColourOfTheirValue) {
  HeatMap map;
  map.values = Matrix::Zero(2, 3);
  map.values(0, 2) = 5;
  map.values(1, 0) = NAN;
  const auto pictures = shapes_of<Picture>(draw(map));
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_EQ(pictures[0].image.at(2, 0), heat_colour(1));
  EXPECT_EQ(pictures[0].image.at(0, 0), heat_colour(0));
  EXPECT_EQ(pictures[0].image.at(0, 1), heat_colour(NAN));
}

TEST(StripDrawing, SegmentsFillTheirTimeInTheirColour) {
  const Drawing strip = draw_segments({{0, 4, 7, "7"}, {4, 6, 2, "2"}, {20, 5, 1, "1"}}, 0, 10, 200, 20);
  const auto boxes = shapes_of<Polygon>(strip);
  ASSERT_EQ(boxes.size(), 2U);
  EXPECT_EQ(boxes[0].fill.colour, unit_colour(7));
  EXPECT_DOUBLE_EQ(boxes[1].points[0].x, 80);
  EXPECT_TRUE(has_text(strip, "2"));
}

TEST(Grid, PanelsStandInRows) {
  const Drawing panel{100, 50, {255, 255, 255, 255}, {Disc{{50, 25}, 3, {0, 0, 0, 255}}}};
  const Drawing figure = grid({panel, panel, panel}, 2, "figure");
  const auto discs = shapes_of<Disc>(figure);
  ASSERT_EQ(discs.size(), 3U);
  EXPECT_EQ(discs[0].centre.y, discs[1].centre.y);
  EXPECT_EQ(discs[0].centre.x, discs[2].centre.x);
  EXPECT_GE(discs[1].centre.x - discs[0].centre.x, 100);
  EXPECT_GE(discs[2].centre.y - discs[0].centre.y, 50);
  EXPECT_LE(discs[2].centre.y + 25, figure.height);
}

TEST(Colours, UnitsDifferAndHeatGrowsLighter) {
  std::set<std::vector<int>> seen;
  for (int i = 0; i < 200; ++i) {
    const Rgba c = unit_colour(i);
    seen.insert({c.r, c.g, c.b});
  }
  EXPECT_GT(seen.size(), 190U);
  const auto luma = [](Rgba c) { return 0.21 * c.r + 0.72 * c.g + 0.07 * c.b; };
  for (int i = 0; i < 20; ++i) EXPECT_LT(luma(heat_colour(i / 20.0)), luma(heat_colour((i + 1) / 20.0)));
}

TEST(Colours, OklchKeepsGreys) {
  const Rgba white = oklch(1, 0, 0), black = oklch(0, 0, 0);
  EXPECT_NEAR(white.r, 255, 1);
  EXPECT_NEAR(white.b, 255, 1);
  EXPECT_EQ(black.g, 0);
}

}  // namespace
}  // namespace motex
