// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include "motex/plot/colour.h"
#include "motex/plot/frame.h"
#include "motex/project/particle_pictures.h"

namespace motex {
namespace {

constexpr Rgba kCore{178, 34, 34, 255};
constexpr double kMargin = 26;
constexpr double kAcross = 0.42, kUp = 0.32;  // how x is drawn: to the right and up
constexpr std::size_t kNumDiscs = 8;          // of a base along its cable

/// A cable in an oblique view of (x, y, t).
class CableView {
 public:
  CableView(const Cable& cable, double width, double height) : cable_(cable) {
    drawing_ = {width, height, {255, 255, 255, 255}, {}};
    widen(cable.core);
    for (const std::vector<Base>& coil : cable.coils) widen(coil);
    const double extent_x = std::max(1.0, right_ - left_), extent_y = std::max(1.0, bottom_ - top_);
    per_pixel_ = std::min((height - 2 * kMargin) / (extent_y + kUp * extent_x), 0.4 * width / (kAcross * extent_x));
    length_ = static_cast<double>(std::max<std::int64_t>(1, cable.num_frames() - 1));
    per_frame_ = std::max(0.5, (width - 2 * kMargin - kAcross * extent_x * per_pixel_) / length_);
    origin_ = {kMargin, kMargin + kUp * extent_x * per_pixel_};
  }

  Drawing draw() {
    draw_box();
    for (std::size_t k = 0; k < cable_.coils.size(); ++k)
      draw_path(cable_.coils[k], unit_colour(static_cast<int>(k) + 1), 1.4);
    draw_path(cable_.core, kCore, 3.4);
    return std::move(drawing_);
  }

 private:
  void widen(const std::vector<Base>& bases) {
    for (const Base& base : bases) {
      left_ = std::min(left_, base.x), right_ = std::max(right_, base.x);
      top_ = std::min(top_, base.y), bottom_ = std::max(bottom_, base.y);
    }
  }
  /// t counts from the birth.
  Point at(double x, double y, double t) const {
    const double u = (x - left_) * per_pixel_, v = (y - top_) * per_pixel_;
    return {origin_.x + t * per_frame_ + kAcross * u, origin_.y + v - kUp * u};
  }

  void draw_box() {
    for (const auto& [x, y] : {std::pair{left_, top_}, {right_, top_}, {right_, bottom_}, {left_, bottom_}})
      drawing_.add(Polyline{{at(x, y, 0), at(x, y, length_)}, kGridLine, 1, 0});
    for (const double t : {0.0, length_}) {
      drawing_.add(Polyline{
          {at(left_, top_, t), at(right_, top_, t), at(right_, bottom_, t), at(left_, bottom_, t), at(left_, top_, t)},
          kFaintInk,
          1,
          0});
      const Point below = at(left_, bottom_, t);
      const std::int64_t frame = cable_.first_frame + static_cast<std::int64_t>(t);
      drawing_.add(Text{{below.x, below.y + 17}, "t = " + std::to_string(frame), 12, kInk, Align::kLeft, false, false});
    }
  }

  void draw_path(const std::vector<Base>& bases, Rgba colour, double width) {
    Polyline line{{}, colour, width, 0};
    for (std::size_t t = 0; t < bases.size(); ++t)
      line.points.push_back(at(bases[t].x, bases[t].y, static_cast<double>(t)));
    const std::size_t step = std::max<std::size_t>(1, bases.size() / kNumDiscs);
    std::vector<Disc> discs;
    for (std::size_t t = 0; t < bases.size(); t += step)
      discs.push_back(
          {line.points[t], std::clamp(0.5 * bases[t].scale * per_pixel_, 1.5, 9.0), with_alpha(colour, 0.55)});
    drawing_.add(std::move(line));
    for (const Disc& disc : discs) drawing_.add(disc);
  }

  const Cable& cable_;
  Drawing drawing_;
  double left_ = HUGE_VAL, right_ = -HUGE_VAL, top_ = HUGE_VAL, bottom_ = -HUGE_VAL;
  double per_pixel_ = 1, per_frame_ = 1, length_ = 1;
  Point origin_;
};

}  // namespace

Drawing cable_picture(const Cable& cable, double width, double height) {
  if (cable.core.empty()) return {width, height, {255, 255, 255, 255}, {}};
  return CableView(cable, width, height).draw();
}

}  // namespace motex
