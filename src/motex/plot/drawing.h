// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "motex/image/image.h"

namespace motex {

/// Place in a drawing: x to the right, y down, in units of one pixel at scale 1, (0, 0) = top left corner.
struct Point {
  double x = 0;
  double y = 0;
};

/// One colour, or a gradient: `stops` evenly spaced from `from` to `to` and constant across that direction.
struct Paint {
  Rgba colour;
  std::vector<Rgba> stops;  ///< empty = `colour` alone, else at least two
  Point from, to;
};

/// An open line with round ends and joins. dash > 0: that long on, that long off.
struct Polyline {
  std::vector<Point> points;
  Rgba colour;
  double width = 1;
  double dash = 0;
};

/// A circle's line, of 24 corners.
Polyline ring(Point centre, double radius, Rgba colour, double width);

/// The inside of a closed outline that does not cross itself.
struct Polygon {
  std::vector<Point> points;
  Paint fill;
};

struct Disc {
  Point centre;
  double radius = 1;
  Rgba colour;
};

enum class Align { kLeft, kCentre, kRight };

/// One line of UTF-8 text; anchor = point on the base line.
struct Text {
  Point anchor;
  std::string text;
  double size = 12;  ///< of the em square; a capital is 0.7 of it high
  Rgba colour;
  Align align = Align::kLeft;
  bool bold = false;
  bool upwards = false;  ///< turned by 90°, read from below to above
};

/// An image stretched over a rectangle; pixels stay hard squares when enlarged and are averaged when shrunk.
struct Picture {
  Point top_left;
  double width = 0;
  double height = 0;
  Image image;
};

using Shape = std::variant<Polyline, Polygon, Disc, Text, Picture>;

/// A picture as the list of its shapes, painted first to last.
struct Drawing {
  double width = 0;
  double height = 0;
  Rgba background{255, 255, 255, 255};
  std::vector<Shape> shapes;

  void add(Shape shape) { shapes.push_back(std::move(shape)); }
};

/// Copies all shapes of `source` into `target`, moved by `offset`; the background is left behind.
void append(Drawing& target, const Drawing& source, Point offset);

/// Corners of a rectangle.
std::vector<Point> rectangle(Point top_left, double width, double height);

/// Pixels of the drawing with `scale` pixels to the unit, anti-aliased. Throws InvalidInput when the size is not
/// positive or beyond 32768 pixels.
Image render(const Drawing& drawing, double scale = 1);

std::string to_png(const Drawing& drawing, double scale = 2);
std::string to_svg(const Drawing& drawing);

/// Writes .png (two pixels to the unit) or .svg, by extension; another extension throws UnsupportedFile.
void write_picture(const std::filesystem::path& path, const Drawing& drawing);

}  // namespace motex
