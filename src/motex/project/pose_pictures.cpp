// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/pose_pictures.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/plot/charts.h"
#include "motex/plot/colour.h"
#include "motex/plot/frame.h"
#include "motex/project/figure.h"

namespace motex {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr Rgba kPaper{255, 255, 255, 255}, kFloorColour{241, 241, 243, 255}, kTrailColour{214, 40, 40, 255};
constexpr double kMargin = 16, kStripHeight = 20, kCaption = 26, kSecsPerFigure = 0.4;

struct ScreenBall {
  Point centre;
  double radius;
};

double cross(Point o, Point a, Point b) { return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x); }

/// Outline of the convex hull of the discs (monotone chain over points on their rims).
std::vector<Point> hull(const std::vector<ScreenBall>& balls, double grow) {
  constexpr int kRim = 28;
  std::vector<Point> rim, out;
  for (const ScreenBall& ball : balls)
    for (int i = 0; i < kRim; ++i) {
      const double angle = 2 * kPi * i / kRim, r = std::max(0.3, ball.radius + grow);
      rim.push_back({ball.centre.x + r * std::cos(angle), ball.centre.y + r * std::sin(angle)});
    }
  std::sort(rim.begin(), rim.end(), [](Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = out.size();
    for (const Point& p : rim) {
      while (out.size() >= start + 2 && cross(out[out.size() - 2], out.back(), p) <= 0) out.pop_back();
      out.push_back(p);
    }
    out.pop_back();
    std::reverse(rim.begin(), rim.end());
  }
  return out;
}

Rgba side_colour(Side side) {
  if (side == Side::kLeft) return oklch(0.60, 0.13, 252);
  if (side == Side::kRight) return oklch(0.71, 0.15, 62);
  return oklch(0.68, 0.018, 265);
}

/// A cylinder's light across the part: the gradient runs over its width, light falls from the upper left.
Paint shaded(const std::vector<ScreenBall>& balls, Rgba colour) {
  const Point a = balls.front().centre, b = balls.back().centre;
  double radius = 0;
  for (const ScreenBall& ball : balls) radius = std::max(radius, ball.radius);
  double dx = b.x - a.x, dy = b.y - a.y;
  double length = std::hypot(dx, dy);
  Point middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
  if (balls.size() > 2 || length < 0.5 * radius) {  // trunks and heads: from one side to the other
    double low = a.x - radius, high = a.x + radius;
    for (const ScreenBall& ball : balls) {
      low = std::min(low, ball.centre.x - ball.radius);
      high = std::max(high, ball.centre.x + ball.radius);
    }
    radius = (high - low) / 2, middle.x = (high + low) / 2, dx = 0, dy = -1, length = 1;
  }
  Point across{-dy / length * radius, dx / length * radius};
  if (across.x + across.y < 0) across = {-across.x, -across.y};
  const Rgba light = mix(colour, {255, 255, 255, 255}, 0.38), dark = mix(colour, {20, 22, 40, 255}, 0.42);
  return {colour,
          {colour, light, mix(light, colour, 0.5), colour, mix(colour, dark, 0.5), dark},
          {middle.x - across.x, middle.y - across.y},
          {middle.x + across.x, middle.y + across.y}};
}

/// Orthographic view; screen = origin + scale · (right · p, −up · p).
struct View {
  Vector3 right, up, towards;
  double scale;
  Point screen(const Vector3& p) const { return {scale * right.dot(p), -scale * up.dot(p)}; }
};

class StripPainter {
 public:
  StripPainter(const FigureMotion& motion, const PoseStripOptions& options)
      : options_(options), figure_(motion.figure), points_(motion.points) {
    floor_ = floor_height(points_);
    choose_times(motion);
    choose_view();
    measure();
  }

  Drawing paint(const FigureMotion& motion, const std::vector<TextonSpan>& spans) {
    const double row_height =
        above_ + below_ + (options_.frame_numbers ? 18 : 4) + (spans.empty() ? 0 : kStripHeight + 8);
    drawing_ = {2 * side_ + options_.figures * spacing_, kCaption + options_.rows * row_height + kMargin, kPaper, {}};
    char caption[160];
    std::snprintf(caption, sizeof caption, "frames %ld – %ld of %ld, %.4g a second", static_cast<long>(first_),
                  static_cast<long>(last_), static_cast<long>(points_.rows()), 1 / motion.frame_time_secs);
    drawing_.add(Text{{kMargin, 19}, motion.name, 13, kInk, Align::kLeft, true, false});
    drawing_.add(Text{{drawing_.width - kMargin, 19}, caption, 11, kFaintInk, Align::kRight, false, false});
    for (int row = 0; row < options_.rows; ++row) paint_row(row, kCaption + row * row_height + above_, spans);
    return std::move(drawing_);
  }

 private:
  void choose_times(const FigureMotion& motion) {
    const Index frames = points_.rows();
    first_ = static_cast<Index>(std::llround(std::min(options_.start_secs / motion.frame_time_secs, 1e15)));
    if (first_ >= frames)
      throw InvalidInput((motion.name.empty() ? "the clip" : motion.name) + " has no frame at " +
                         std::to_string(options_.start_secs) + " s to draw");
    if (frames - first_ < options_.figures) {
      options_.figures = static_cast<int>(frames - first_);
      options_.rows = 1;
    }
    const int count = options_.figures * options_.rows;
    const double secs = options_.secs > 0 ? options_.secs : kSecsPerFigure * (count - 1);
    const double wanted = std::min(secs / motion.frame_time_secs, 1e15);
    last_ = std::min(frames - 1, first_ + static_cast<Index>(std::llround(wanted)));
    step_ = count > 1 ? static_cast<double>(last_ - first_) / (count - 1) : 0;
  }

  void choose_view() {
    Vector3 ahead = Vector3::Zero();
    for (Index t = first_; t <= last_; ++t)
      if (const Vector3 front = facing(figure_, points_, t); front.allFinite()) ahead += front;
    if (ahead.norm() < 0.1 * static_cast<double>(last_ - first_ + 1)) ahead = facing(figure_, points_, first_);
    if (!ahead.allFinite()) ahead = Vector3::UnitZ();
    const Vector3 front = Eigen::AngleAxisd(options_.azimuth_deg * kPi / 180, Vector3::UnitY()) * ahead.normalized();
    const double pitch = options_.elevation_deg * kPi / 180;
    view_.right = Vector3::UnitY().cross(front);
    view_.towards = std::cos(pitch) * front + std::sin(pitch) * Vector3::UnitY();
    view_.up = std::cos(pitch) * Vector3::UnitY() - std::sin(pitch) * front;
    view_.scale = options_.figure_height / figure_.height;
    spacing_ = 0.66 * options_.figure_height;
  }

  /// Room above and below the place on the floor that the shown figures need.
  void measure() {
    above_ = 0.4 * options_.figure_height, below_ = 0.12 * options_.figure_height;
    for (Index t = first_; t <= last_; ++t)
      for (const BodyPart& part : figure_.parts)
        for (const Ball& ball : part.balls) {
          const auto [x, y] = place(t, ball.point_idx);
          if (!std::isfinite(x + y)) continue;
          const double r = ball.radius * view_.scale;
          above_ = std::max(above_, r - y + 6);
          below_ = std::max(below_, y + r + 6);
          side_ = std::max(side_, std::abs(x) + r + 6 - spacing_ / 2);
        }
  }

  Vector3 position(Index frame, int point) const { return points_.block<1, 3>(frame, 3 * point).transpose(); }

  /// The point on the floor under the hips, or under the mean of all points that are seen.
  Vector3 ground(Index frame) const {
    Vector3 centre = Vector3::Constant(std::nan(""));
    if (figure_.hips[0] >= 0 && figure_.hips[1] >= 0)
      centre = (position(frame, figure_.hips[0]) + position(frame, figure_.hips[1])) / 2;
    if (!centre.allFinite()) {
      double num_seen = 0;
      centre.setZero();
      for (Index p = 0; p < figure_.num_points; ++p)
        if (const Vector3 seen = position(frame, static_cast<int>(p)); seen.allFinite()) centre += seen, ++num_seen;
      centre /= std::max(num_seen, 1.0);
    }
    centre.y() = floor_;
    return centre;
  }

  /// On the screen, relative to the figure's place on the floor.
  Point place(Index frame, int point) const { return view_.screen(position(frame, point) - ground(frame)); }

  Index frame_of(double figure) const {
    return std::clamp(first_ + static_cast<Index>(std::llround(figure * step_)), first_, last_);
  }
  double x_of(int row, double figure) const { return side_ + (figure - row * options_.figures + 0.5) * spacing_; }

  void paint_row(int row, double floor_y, const std::vector<TextonSpan>& spans) {
    const int first = row * options_.figures, last = first + options_.figures - 1;
    const double depth = 0.09 * options_.figure_height;
    drawing_.add(
        Polygon{rectangle({kMargin, floor_y - depth}, drawing_.width - 2 * kMargin, 2 * depth),
                {{}, {kPaper, kFloorColour, kFloorColour, kPaper}, {0, floor_y - depth}, {0, floor_y + depth}}});
    for (int k = first; k <= last; ++k) paint_shadow(frame_of(k), {x_of(row, k), floor_y});
    for (int k = first; k < last; ++k)
      for (int g = 1; g <= options_.ghosts; ++g) {
        const double at = k + static_cast<double>(g) / (options_.ghosts + 1);
        paint_ghost(frame_of(at), {x_of(row, at), floor_y});
      }
    if (options_.trails) paint_trails(row, floor_y, with_alpha(kTrailColour, 0.95));
    for (int k = first; k <= last; ++k) paint_figure(frame_of(k), {x_of(row, k), floor_y});
    if (options_.trails) paint_trails(row, floor_y, with_alpha(kTrailColour, 0.45));
    double y = floor_y + below_;
    if (options_.frame_numbers) {
      for (int k = first; k <= last; ++k)
        drawing_.add(
            Text{{x_of(row, k), y + 12}, std::to_string(frame_of(k)), 10, kFaintInk, Align::kCentre, false, false});
      y += 18;
    }
    if (!spans.empty()) paint_textons(row, y, spans);
  }

  void paint_shadow(Index frame, Point at) {
    const double flat = std::max(0.12, std::sin(options_.elevation_deg * kPi / 180));
    const auto blob = [&](Point centre, double radius, double alpha) {
      for (int ring = 1; ring <= 6; ++ring) {
        std::vector<Point> ellipse;
        for (int i = 0; i < 32; ++i) {
          const double angle = 2 * kPi * i / 32, r = radius * ring / 6;
          ellipse.push_back({centre.x + r * std::cos(angle), centre.y + flat * r * std::sin(angle)});
        }
        drawing_.add(Polygon{std::move(ellipse), {with_alpha({40, 44, 60, 255}, alpha / 6), {}, {}, {}}});
      }
    };
    blob(at, 0.26 * options_.figure_height, 0.20);
    for (const int foot : figure_.feet) {
      if (foot < 0) continue;
      Vector3 on_floor = position(frame, foot) - ground(frame);
      if (!on_floor.allFinite()) continue;
      const double lift = std::max(0.0, on_floor.y() / figure_.height);
      on_floor.y() = 0;
      const Point p = view_.screen(on_floor);
      blob({at.x + p.x, at.y + p.y}, 0.09 * options_.figure_height, 0.34 * std::max(0.0, 1 - 4 * lift));
    }
  }

  struct ScreenPart {
    std::vector<ScreenBall> balls;
    double depth = 0;
    Side side = Side::kMiddle;
  };

  std::vector<ScreenPart> back_to_front(Index frame, Point at) const {
    std::vector<ScreenPart> parts;
    for (const BodyPart& part : figure_.parts) {
      ScreenPart out;
      out.side = part.side;
      for (const Ball& ball : part.balls) {
        const Point p = place(frame, ball.point_idx);
        out.balls.push_back({{at.x + p.x, at.y + p.y}, ball.radius * view_.scale});
        out.depth += view_.towards.dot(position(frame, ball.point_idx)) / static_cast<double>(part.balls.size());
      }
      if (std::isfinite(out.depth)) parts.push_back(std::move(out));
    }
    std::stable_sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.depth < b.depth; });
    return parts;
  }

  void paint_figure(Index frame, Point at) {
    for (const ScreenPart& part : back_to_front(frame, at)) {
      const Rgba colour = side_colour(part.side);
      drawing_.add(Polygon{hull(part.balls, 0.8), {mix(colour, {24, 26, 44, 255}, 0.62), {}, {}, {}}});
      drawing_.add(Polygon{hull(part.balls, 0), shaded(part.balls, colour)});
    }
  }

  void paint_ghost(Index frame, Point at) {
    for (const ScreenPart& part : back_to_front(frame, at))
      drawing_.add(Polygon{hull(part.balls, -0.3), {mix(side_colour(part.side), kPaper, 0.82), {}, {}, {}}});
  }

  void paint_trails(int row, double floor_y, Rgba colour) {
    const double first = row * options_.figures, last = first + options_.figures - 1;
    if (step_ <= 0) return;
    for (const int point : {figure_.hands[1], figure_.feet[1]}) {
      if (point < 0) continue;
      Polyline line{{}, colour, 1.7, 0};
      for (Index t = frame_of(first); t <= frame_of(last); ++t) {
        const double figure = static_cast<double>(t - first_) / step_;
        const Point p = place(t, point);
        if (!std::isfinite(p.x + p.y)) continue;
        line.points.push_back({x_of(row, figure) + p.x, floor_y + p.y});
      }
      drawing_.add(std::move(line));
    }
  }

  void paint_textons(int row, double y, const std::vector<TextonSpan>& spans) {
    const double per_figure = std::max(step_, 1e-9);
    const double left = static_cast<double>(first_) + (row * options_.figures - 0.5) * per_figure;
    std::vector<StripSegment> segments;
    for (const TextonSpan& span : spans)
      segments.push_back({static_cast<double>(span.start), static_cast<double>(span.length), span.texton,
                          std::to_string(span.texton)});
    append(
        drawing_,
        draw_segments(segments, left, left + options_.figures * per_figure, options_.figures * spacing_, kStripHeight),
        {side_, y});
  }

  PoseStripOptions options_;
  Figure figure_;
  FrameMatrix points_;
  double floor_ = 0, step_ = 0, spacing_ = 0;
  double above_ = 0, below_ = 0, side_ = kMargin;  // room around the outermost figures
  Index first_ = 0, last_ = 0;
  View view_;
  Drawing drawing_;
};

}  // namespace

Drawing pose_strip(const Clip& clip, const std::vector<TextonSpan>& spans, const PoseStripOptions& options) {
  check_options(options);
  check_clip(clip);
  return pose_strip(figure_motion(clip), spans, options);
}

Drawing pose_strip(const FigureMotion& motion, const std::vector<TextonSpan>& spans, const PoseStripOptions& options) {
  check_options(options);
  return StripPainter(motion, options).paint(motion, spans);
}

}  // namespace motex
