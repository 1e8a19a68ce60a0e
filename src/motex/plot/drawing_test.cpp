// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/plot/drawing.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "motex/core/error.h"
#include "motex/core/files.h"
#include "motex/image/png.h"
#include "motex/plot/stroke_font.h"

namespace motex {
namespace {

constexpr Rgba kWhite{255, 255, 255, 255}, kRed{255, 0, 0, 255}, kBlue{0, 0, 255, 255};

Drawing sheet() { return {40, 30, kWhite, {}}; }

TEST(Drawing, RejectsEmptyAndGiantPictures) {
  EXPECT_THROW(render(Drawing{}), InvalidInput);
  EXPECT_THROW(render(Drawing{1e6, 10, kWhite, {}}), InvalidInput);
  EXPECT_THROW(render(sheet(), 0), InvalidInput);
}

TEST(Drawing, UnknownExtensionIsRefused) {
  EXPECT_THROW(write_picture("/tmp/picture.bmp", sheet()), UnsupportedFile);
  EXPECT_THROW(write_picture("/no/such/folder/picture.png", sheet()), InvalidInput);
}

TEST(Drawing, ShapesArePaintedInOrderAtTheirPlace) {
  Drawing drawing = sheet();
  drawing.add(Polygon{rectangle({0, 0}, 20, 30), {kRed, {}, {}, {}}});
  drawing.add(Disc{{10, 15}, 5, kBlue});
  const Image image = render(drawing, 2);
  EXPECT_EQ(image.width, 80);
  EXPECT_EQ(image.height, 60);
  EXPECT_EQ(image.at(20, 30), kBlue);
  EXPECT_EQ(image.at(2, 2), kRed);
  EXPECT_EQ(image.at(60, 30), kWhite);
}

TEST(Drawing, GradientRunsFromStopToStop) {
  Drawing drawing = sheet();
  drawing.add(Polygon{rectangle({0, 0}, 40, 30), {{}, {kRed, kWhite, kBlue}, {0, 0}, {40, 0}}});
  const Image image = render(drawing);
  EXPECT_GT(image.at(0, 3).r, 250);
  EXPECT_GT(image.at(20, 3).g, 240);
  EXPECT_GT(image.at(39, 3).b, 250);
  EXPECT_LT(image.at(39, 3).r, 20);
}

TEST(Drawing, PicturesKeepHardPixelsAndAverageWhenShrunk) {
  Image two(2, 1, kRed);
  two.at(1, 0) = kBlue;
  Drawing drawing = sheet();
  drawing.add(Picture{{0, 0}, 20, 10, two});
  drawing.add(Picture{{30, 20}, 1, 1, two});
  const Image image = render(drawing);
  EXPECT_EQ(image.at(9, 5), kRed);
  EXPECT_EQ(image.at(10, 5), kBlue);
  EXPECT_EQ(image.at(20, 5), kWhite);
  EXPECT_EQ(image.at(30, 20), (Rgba{128, 0, 128, 255}));
}

TEST(Drawing, AppendMovesEveryShape) {
  Drawing part = sheet(), whole = sheet();
  part.add(Disc{{5, 5}, 3, kRed});
  part.add(Text{{0, 20}, "H", 20, kBlue, Align::kLeft, true, false});
  append(whole, part, {20, 5});
  EXPECT_EQ(render(whole).at(25, 10), kRed);
  EXPECT_EQ(render(whole).at(5, 5), kWhite);
  EXPECT_EQ(std::get<Text>(whole.shapes[1]).anchor.x, 20);
}

TEST(Drawing, TextIsAlignedAndTurned) {
  const auto ink_centre = [](Text text) {
    Drawing drawing{200, 200, kWhite, {}};
    drawing.add(std::move(text));
    const Image image = render(drawing);
    double x = 0, y = 0, weight = 0;
    for (int j = 0; j < 200; ++j)
      for (int i = 0; i < 200; ++i) {
        const double ink = 255 - image.at(i, j).g;
        x += ink * i, y += ink * j, weight += ink;
      }
    EXPECT_GT(weight, 0);
    return Point{x / weight, y / weight};
  };
  const Text text{{100, 100}, "HHHH", 20, kBlue, Align::kLeft, false, false};
  const auto with = [&](Align align, bool upwards) {
    Text t = text;
    t.align = align, t.upwards = upwards;
    return ink_centre(t);
  };
  const double width = text_width("HHHH", 20);
  EXPECT_NEAR(with(Align::kLeft, false).x, 100 + width / 2, 2);
  EXPECT_NEAR(with(Align::kCentre, false).x, 100, 2);
  EXPECT_NEAR(with(Align::kRight, false).x, 100 - width / 2, 2);
  EXPECT_NEAR(with(Align::kLeft, false).y, 93, 2);
  EXPECT_NEAR(with(Align::kLeft, true).x, 93, 2);
  EXPECT_NEAR(with(Align::kLeft, true).y, 100 - width / 2, 2);
}

TEST(Font, EveryPrintableAsciiCharacterHasItsOwnGlyph) {
  const auto missing = text_strokes("\xf4\x80\x80\x80", 20);
  for (char c = '!'; c <= '~'; ++c) {
    const auto strokes = text_strokes(std::string(1, c), 20);
    ASSERT_FALSE(strokes.empty()) << c;
    bool same = strokes.size() == missing.size() && strokes[0].size() == missing[0].size();
    for (std::size_t i = 0; same && i < missing[0].size(); ++i)
      same = strokes[0][i].x == missing[0][i].x && strokes[0][i].y == missing[0][i].y;
    EXPECT_FALSE(same) << c;
    for (const auto& stroke : strokes)
      for (const Point& p : stroke) {
        EXPECT_GE(p.x, 0) << c;
        EXPECT_LE(p.x, text_width(std::string(1, c), 20)) << c;
        EXPECT_LE(std::abs(p.y + 5), 15) << c;
      }
  }
}

TEST(Font, BrokenUtf8BecomesBoxes) {
  EXPECT_EQ(text_strokes("\xff", 20).size(), 1U);
  EXPECT_EQ(text_strokes("\xe2\x82", 20).size(), 2U);
  EXPECT_EQ(text_width("\xc2\xb0", 20), text_width("\xc2\xb0", 10) * 2);
}

TEST(Svg, EscapesTextAndNamesEveryShape) {
  Drawing drawing = sheet();
  drawing.add(Text{{1, 9}, "a<b & \"c\"\x01", 12, kBlue, Align::kCentre, false, true});
  drawing.add(Polyline{{{0, 0}, {3, 4}}, with_alpha(kRed, 0.5), 2, 3});
  drawing.add(Polygon{rectangle({0, 0}, 4, 4), {{}, {kRed, kBlue}, {0, 0}, {4, 0}}});
  drawing.add(Disc{{3, 3}, 2, kRed});
  drawing.add(Picture{{0, 0}, 4, 4, Image(1, 1, kRed)});
  const std::string svg = to_svg(drawing);
  for (const char* part : {"a&lt;b &amp; &quot;c&quot;\xef\xbf\xbd<", "stroke-opacity=\"0.5\"",
                           "stroke-dasharray=\"3\"", "<linearGradient", "fill=\"url(#g0)\"", "stop-color=\"#0000ff\"",
                           "<circle", "data:image/png;base64,iVBOR", "rotate(-90 1 9)"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
}

TEST(Drawing, FilesByExtension) {
  const auto folder = std::filesystem::temp_directory_path();
  const auto png = folder / "motex_drawing_test.PNG", svg = folder / "motex_drawing_test.svg";
  write_picture(png, sheet());
  write_picture(svg, sheet());
  EXPECT_EQ(decode_png(read_file(png), "x").width, 80);
  EXPECT_EQ(read_file(svg).substr(0, 4), "<svg");
  std::filesystem::remove(png);
  std::filesystem::remove(svg);
}

}  // namespace
}  // namespace motex
