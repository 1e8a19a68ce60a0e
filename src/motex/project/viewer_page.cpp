// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/viewer_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "motex/core/base64.h"
#include "motex/core/error.h"
#include "motex/core/xml_escape.h"
#include "motex/plot/colour.h"
#include "motex/project/figure.h"
#include "motex/project/viewer_source.h"

namespace motex {
namespace {

using nlohmann::json;

constexpr double kMaxQuantum = 65534;
constexpr unsigned kNotSeen = 65535;

/// Positions as 16-bit numbers: position = origin + step · quantum, the same step for all axes.
struct QuantisedPoints {
  Vector3 origin;
  double step = 1;
  std::string bytes;  ///< frames × points × 3, little-endian
};

QuantisedPoints quantise(const FrameMatrix& points) {
  QuantisedPoints out;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vector3 high = Vector3::Constant(-kInfinity);
  out.origin = Vector3::Constant(kInfinity);
  for (Index t = 0; t < points.rows(); ++t)
    for (Index c = 0; c < points.cols(); ++c) {
      if (std::isnan(points(t, c))) continue;
      out.origin[c % 3] = std::min(out.origin[c % 3], points(t, c));
      high[c % 3] = std::max(high[c % 3], points(t, c));
    }
  if (!out.origin.allFinite()) out.origin = high = Vector3::Zero();
  const double extent = (high - out.origin).maxCoeff();
  out.step = extent > 0 ? extent / kMaxQuantum : 1;
  out.bytes.reserve(static_cast<std::size_t>(points.size()) * 2);
  for (Index t = 0; t < points.rows(); ++t)
    for (Index c = 0; c < points.cols(); ++c) {
      const bool seen = !std::isnan(points(t, c));
      const auto quantum =
          seen ? static_cast<unsigned>(std::lround((points(t, c) - out.origin[c % 3]) / out.step)) : kNotSeen;
      out.bytes += static_cast<char>(quantum & 255U);
      out.bytes += static_cast<char>(quantum >> 8U);
    }
  return out;
}

std::string hex(Rgba c) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned>(c.r), static_cast<unsigned>(c.g),
                static_cast<unsigned>(c.b));
  return text;
}

json json_parts(const Figure& figure) {
  json parts = json::array();
  for (const BodyPart& part : figure.parts) {
    json balls = json::array();
    for (const Ball& ball : part.balls) balls.push_back({ball.point_idx, ball.radius});
    parts.push_back({{"side", static_cast<int>(part.side)}, {"balls", balls}});
  }
  return parts;
}

json json_spans(const std::vector<TextonSpan>& spans, Index num_frames) {
  json out = json::array();
  for (const TextonSpan& span : spans) {
    if (span.start < 0 || span.length < 0 || span.start > num_frames || span.length > num_frames - span.start)
      throw InvalidInput("a texton's frames " + std::to_string(span.start) + " … " +
                         std::to_string(span.start + span.length - 1) + " are not all in the clip");
    out.push_back({{"texton", span.texton},
                   {"start", span.start},
                   {"length", span.length},
                   {"source", span.source},
                   {"colour", hex(unit_colour(span.texton))}});
  }
  return out;
}

/// The points that leave a trail with their sides, and the points whose mean is the middle of the body.
void add_special_points(const Figure& figure, json& data) {
  data["trails"] = json::array();
  data["trailSides"] = json::array();
  for (const auto& pair : {figure.hands, figure.feet})
    for (std::size_t s = 0; s < 2; ++s) {
      if (pair[s] < 0) continue;
      data["trails"].push_back(pair[s]);
      data["trailSides"].push_back(static_cast<int>(s == 0 ? Side::kLeft : Side::kRight));
    }
  data["centre"] = json::array();
  for (int p = 0; p < figure.num_points; ++p)
    if (figure.hips[0] < 0 || figure.hips[1] < 0 || p == figure.hips[0] || p == figure.hips[1])
      data["centre"].push_back(p);
}

/// JSON that may stand inside a script element: no '<', so neither "</script" nor "<!--".
std::string script_safe(const json& data) {
  const std::string text = data.dump(-1, ' ', true, json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

std::string page_data(const FigureMotion& motion, const std::string& title, const std::vector<TextonSpan>& spans) {
  const Figure& figure = motion.figure;
  FrameMatrix points = motion.points;
  const double floor = floor_height(points);
  for (Index c = 1; c < points.cols(); c += 3) points.col(c).array() -= floor;
  const QuantisedPoints quantised = quantise(points);
  Vector3 front = facing(figure, points, 0);
  if (!front.allFinite()) front = Vector3::UnitZ();
  json data = {{"name", title},
               {"frameTimeSecs", motion.frame_time_secs},
               {"numFrames", points.rows()},
               {"numPoints", figure.num_points},
               {"origin", {quantised.origin.x(), quantised.origin.y(), quantised.origin.z()}},
               {"step", quantised.step},
               {"scale", 1.7 / figure.height},
               {"frontYaw", std::atan2(front.x(), front.z())},
               {"parts", json_parts(figure)},
               {"spans", json_spans(spans, points.rows())},
               {"points", base64_encode(quantised.bytes)}};
  add_special_points(figure, data);
  return script_safe(data);
}

}  // namespace

std::string viewer_page(const Clip& clip, const std::vector<TextonSpan>& spans, const ViewerPageOptions& options) {
  check_clip(clip);
  return viewer_page(figure_motion(clip), spans, options);
}

std::string viewer_page(const FigureMotion& motion, const std::vector<TextonSpan>& spans,
                        const ViewerPageOptions& options) {
  const std::string title = options.title.empty() ? motion.name : options.title;
  if (motion.points.rows() == 0) throw InvalidInput((title.empty() ? "the clip" : title) + " has no frame to show");
  std::string page(kViewerHtml);
  const auto fill = [&page](std::string_view mark, std::string_view text) {
    page.replace(page.find(mark), mark.size(), text);
  };
  // From the end of the page, so that no text that was filled in is searched for a mark.
  fill("@SCRIPT@", kViewerJs);
  fill("@DATA@", page_data(motion, title, spans));
  fill("@STYLE@", kViewerCss);
  fill("@TITLE@", xml_escaped(title));
  return page;
}

}  // namespace motex
