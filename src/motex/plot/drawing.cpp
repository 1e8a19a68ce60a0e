// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/plot/drawing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/core/extension.h"
#include "motex/core/files.h"
#include "motex/image/png.h"

namespace motex {
namespace {

struct Mover {
  Point offset;
  void operator()(Point& p) const { p = {p.x + offset.x, p.y + offset.y}; }
  void operator()(Polyline& s) const { std::for_each(s.points.begin(), s.points.end(), *this); }
  void operator()(Polygon& s) const {
    std::for_each(s.points.begin(), s.points.end(), *this);
    (*this)(s.fill.from);
    (*this)(s.fill.to);
  }
  void operator()(Disc& s) const { (*this)(s.centre); }
  void operator()(Text& s) const { (*this)(s.anchor); }
  void operator()(Picture& s) const { (*this)(s.top_left); }
};

}  // namespace

void append(Drawing& target, const Drawing& source, Point offset) {
  for (Shape shape : source.shapes) {
    std::visit(Mover{offset}, shape);
    target.add(std::move(shape));
  }
}

Polyline ring(Point centre, double radius, Rgba colour, double width) {
  constexpr int kCorners = 24;
  Polyline line{{}, colour, width, 0};
  for (int k = 0; k <= kCorners; ++k) {
    const double angle = 2 * std::numbers::pi * k / kCorners;
    line.points.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return line;
}

std::vector<Point> rectangle(Point top_left, double width, double height) {
  const auto [x, y] = top_left;
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

std::string to_png(const Drawing& drawing, double scale) { return encode_png(render(drawing, scale)); }

void write_picture(const std::filesystem::path& path, const Drawing& drawing) {
  const std::string extension = extension_of(path);
  if (extension == ".png")
    write_file(path, to_png(drawing));
  else if (extension == ".svg")
    write_file(path, to_svg(drawing));
  else
    throw UnsupportedFile(path.string() + ": pictures are written as .png or .svg");
}

}  // namespace motex
