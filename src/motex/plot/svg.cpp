// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "motex/core/base64.h"
#include "motex/core/xml_escape.h"
#include "motex/image/png.h"
#include "motex/plot/drawing.h"
#include "motex/plot/stroke_font.h"

namespace motex {
namespace {

/// At most two decimals, no trailing zeros.
std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  std::string out = text;
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out == "-0" ? "0" : out;
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + '"';
}
std::string attribute(const char* name, double value) { return attribute(name, number(value)); }

/// name: fill, stroke or stop.
std::string paint(const std::string& name, Rgba c) {
  char hex[8];
  std::snprintf(hex, sizeof hex, "#%02x%02x%02x", static_cast<unsigned>(c.r), static_cast<unsigned>(c.g),
                static_cast<unsigned>(c.b));
  std::string out = attribute(name == "stop" ? "stop-color" : name.c_str(), hex);
  if (c.a != 255) out += attribute((name + "-opacity").c_str(), c.a / 255.0);
  return out;
}

std::string point_list(const std::vector<Point>& points) {
  std::string out;
  for (const Point& p : points) out += (out.empty() ? "" : " ") + number(p.x) + ',' + number(p.y);
  return attribute("points", out);
}

class SvgWriter {
 public:
  std::string body;

  void operator()(const Polyline& s) {
    body += "<polyline fill=\"none\"" + point_list(s.points) + paint("stroke", s.colour) +
            attribute("stroke-width", s.width);
    if (s.dash > 0) body += attribute("stroke-dasharray", s.dash);
    body += "/>\n";
  }

  void operator()(const Polygon& s) {
    const std::string fill = s.fill.stops.empty() ? paint("fill", s.fill.colour) : define_gradient(s.fill);
    body += "<polygon" + point_list(s.points) + fill + "/>\n";
  }

  void operator()(const Disc& s) {
    body += "<circle" + attribute("cx", s.centre.x) + attribute("cy", s.centre.y) + attribute("r", s.radius) +
            paint("fill", s.colour) + "/>\n";
  }

  void operator()(const Text& s) {
    static constexpr const char* kAnchors[] = {"start", "middle", "end"};
    body += "<text" + attribute("x", s.anchor.x) + attribute("y", s.anchor.y) + attribute("font-size", s.size) +
            attribute("text-anchor", kAnchors[static_cast<int>(s.align)]) + paint("fill", s.colour);
    // The viewer's font may be wider than ours, for which the drawing was laid out.
    if (!s.text.empty())
      body += attribute("textLength", text_width(s.text, s.size)) + " lengthAdjust=\"spacingAndGlyphs\"";
    if (s.bold) body += " font-weight=\"600\"";
    if (s.upwards) body += attribute("transform", "rotate(-90 " + number(s.anchor.x) + ' ' + number(s.anchor.y) + ')');
    body += '>' + xml_escaped(s.text) + "</text>\n";
  }

  void operator()(const Picture& s) {
    if (s.image.pixels.empty()) return;
    body += "<image preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\"" + attribute("x", s.top_left.x) +
            attribute("y", s.top_left.y) + attribute("width", s.width) + attribute("height", s.height) +
            attribute("href", "data:image/png;base64," + base64_encode(encode_png(s.image))) + "/>\n";
  }

 private:
  std::string define_gradient(const Paint& fill) {
    const std::string id = "g" + std::to_string(num_gradients_++);
    body += "<linearGradient gradientUnits=\"userSpaceOnUse\"" + attribute("id", id) + attribute("x1", fill.from.x) +
            attribute("y1", fill.from.y) + attribute("x2", fill.to.x) + attribute("y2", fill.to.y) + ">";
    for (std::size_t i = 0; i < fill.stops.size(); ++i)
      body += "<stop" + attribute("offset", static_cast<double>(i) / static_cast<double>(fill.stops.size() - 1)) +
              paint("stop", fill.stops[i]) + "/>";
    body += "</linearGradient>\n";
    return attribute("fill", "url(#" + id + ")");
  }

  int num_gradients_ = 0;
};

}  // namespace

std::string to_svg(const Drawing& drawing) {
  const std::string width = number(drawing.width), height = number(drawing.height);
  SvgWriter writer;
  for (const Shape& shape : drawing.shapes) std::visit(writer, shape);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height + "\" viewBox=\"0 0 " +
         width + ' ' + height + "\" font-family=\"Helvetica, Arial, sans-serif\" stroke-linecap=\"round\"" +
         " stroke-linejoin=\"round\">\n<rect width=\"100%\" height=\"100%\"" + paint("fill", drawing.background) +
         "/>\n" + writer.body + "</svg>\n";
}

}  // namespace motex
