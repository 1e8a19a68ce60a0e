// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/plot/coverage.h"
#include "motex/plot/drawing.h"
#include "motex/plot/stroke_font.h"

namespace motex {
namespace {

/// Average of the source pixels under one target pixel, or the one pixel that it falls into.
Rgba sample(const Image& image, double x_a, double x_b, double y_a, double y_b) {
  const int left = std::clamp(static_cast<int>(x_a), 0, image.width - 1);
  const int top = std::clamp(static_cast<int>(y_a), 0, image.height - 1);
  const int right = std::clamp(static_cast<int>(std::ceil(x_b)), left + 1, image.width);
  const int bottom = std::clamp(static_cast<int>(std::ceil(y_b)), top + 1, image.height);
  if (x_b - x_a <= 1 && y_b - y_a <= 1)
    return image.at(std::clamp(static_cast<int>((x_a + x_b) / 2), 0, image.width - 1),
                    std::clamp(static_cast<int>((y_a + y_b) / 2), 0, image.height - 1));
  double sum[4] = {};
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) {
      const Rgba p = image.at(x, y);
      sum[0] += p.r, sum[1] += p.g, sum[2] += p.b, sum[3] += p.a;
    }
  const double count = static_cast<double>(right - left) * (bottom - top);
  const auto mean = [&](int k) { return static_cast<std::uint8_t>(sum[k] / count + 0.5); };
  return {mean(0), mean(1), mean(2), mean(3)};
}

class Renderer {
 public:
  Renderer(const Drawing& drawing, double scale)
      : scale_(scale),
        image_(static_cast<int>(std::ceil(drawing.width * scale - 1e-9)),
               static_cast<int>(std::ceil(drawing.height * scale - 1e-9)), drawing.background),
        coverage_(image_.width, image_.height) {}

  Image finish() { return std::move(image_); }

  void operator()(const Polyline& shape) {
    if (shape.dash <= 0) return stroke(shape.points, shape.width, shape.colour);
    for (const auto& piece : dashes(shape.points, shape.dash)) stroke(piece, shape.width, shape.colour);
  }

  void operator()(const Polygon& shape) {
    Paint paint = shape.fill;
    paint.from = scaled(paint.from);
    paint.to = scaled(paint.to);
    coverage_.add_outline(scaled(shape.points));
    coverage_.paint(paint, image_);
  }

  void operator()(const Disc& shape) { stroke({shape.centre}, 2 * shape.radius, shape.colour); }

  void operator()(const Text& shape) {
    const double width = text_width(shape.text, shape.size);
    const double back = shape.align == Align::kLeft ? 0 : shape.align == Align::kCentre ? width / 2 : width;
    for (auto line : text_strokes(shape.text, shape.size)) {
      for (Point& p : line) {
        const double along = p.x - back;
        p = shape.upwards ? Point{shape.anchor.x + p.y, shape.anchor.y - along}
                          : Point{shape.anchor.x + along, shape.anchor.y + p.y};
      }
      add_stroke(line, pen_width(shape.size, shape.bold));
    }
    coverage_.paint({shape.colour, {}, {}, {}}, image_);
  }

  void operator()(const Picture& shape) {
    if (shape.image.pixels.empty() || shape.width <= 0 || shape.height <= 0) return;
    const Point corner = scaled(shape.top_left);
    const double width = shape.width * scale_, height = shape.height * scale_;
    const auto edge = [](double at, int limit) { return std::clamp(static_cast<int>(std::lround(at)), 0, limit); };
    const int left = edge(corner.x, image_.width), right = edge(corner.x + width, image_.width);
    const int top = edge(corner.y, image_.height), bottom = edge(corner.y + height, image_.height);
    const double step_x = shape.image.width / width, step_y = shape.image.height / height;
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x) {
        const double from_x = (x - corner.x) * step_x, from_y = (y - corner.y) * step_y;
        blend(image_.at(x, y), sample(shape.image, from_x, from_x + step_x, from_y, from_y + step_y), 1);
      }
  }

 private:
  Point scaled(Point p) const { return {p.x * scale_, p.y * scale_}; }
  std::vector<Point> scaled(std::vector<Point> points) const {
    for (Point& p : points) p = scaled(p);
    return points;
  }
  void add_stroke(const std::vector<Point>& points, double width) {
    for (const auto& outline : stroke_outlines(scaled(points), width * scale_)) coverage_.add_outline(outline);
  }
  void stroke(const std::vector<Point>& points, double width, Rgba colour) {
    if (points.empty()) return;
    add_stroke(points, width);
    coverage_.paint({colour, {}, {}, {}}, image_);
  }

  double scale_;
  Image image_;
  Coverage coverage_;
};

}  // namespace

Image render(const Drawing& drawing, double scale) {
  const bool fits = drawing.width * scale <= 32768 && drawing.height * scale <= 32768;
  if (!(drawing.width > 0 && drawing.height > 0 && scale > 0) || !fits)
    throw InvalidInput("a picture must be 1 … 32768 pixels wide and high");
  Renderer renderer(drawing, scale);
  for (const Shape& shape : drawing.shapes) std::visit(renderer, shape);
  return renderer.finish();
}

}  // namespace motex
