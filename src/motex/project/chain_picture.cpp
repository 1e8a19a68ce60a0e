// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "motex/core/error.h"
#include "motex/plot/frame.h"
#include "motex/project/particle_pictures.h"

namespace motex {
namespace {

using std::numbers::pi;

constexpr Rgba kWhite{255, 255, 255, 255};

std::vector<Point> circle(Point centre, double radius, double from) {
  constexpr int kCorners = 60;
  std::vector<Point> points;
  for (int k = 0; k <= kCorners; ++k) {
    const double turn = from + 2 * pi * k / kCorners;
    points.push_back({centre.x + radius * std::cos(turn), centre.y + radius * std::sin(turn)});
  }
  return points;
}

/// A quadratic arc from a to b, bent to its left by `bend` of its length.
std::vector<Point> arc(Point a, Point b, double bend) {
  const Point middle{(a.x + b.x) / 2 + bend * (b.y - a.y), (a.y + b.y) / 2 - bend * (b.x - a.x)};
  std::vector<Point> points;
  constexpr int kSteps = 96;
  for (int k = 0; k <= kSteps; ++k) {
    const double s = static_cast<double>(k) / kSteps;
    const double p = (1 - s) * (1 - s), q = 2 * s * (1 - s), r = s * s;
    points.push_back({p * a.x + q * middle.x + r * b.x, p * a.y + q * middle.y + r * b.y});
  }
  return points;
}

/// Without what lies inside the discs of radius r about its ends.
std::vector<Point> between_discs(const std::vector<Point>& line, Point a, Point b, double r) {
  std::vector<Point> kept;
  for (const Point& p : line)
    if (std::hypot(p.x - a.x, p.y - a.y) >= r && std::hypot(p.x - b.x, p.y - b.y) >= r) kept.push_back(p);
  return kept;
}

void add_arrow(Drawing& drawing, std::vector<Point> line, double width) {
  if (line.size() < 2) return;
  const Point tip = line.back(), before = line[line.size() - 2];
  const double angle = std::atan2(tip.y - before.y, tip.x - before.x), size = 7 + 1.5 * width;
  const auto corner = [&](double turn) {
    return Point{tip.x - size * std::cos(angle + turn), tip.y - size * std::sin(angle + turn)};
  };
  const Point back{tip.x - 0.7 * size * std::cos(angle), tip.y - 0.7 * size * std::sin(angle)};
  line.back() = back;
  drawing.add(Polyline{std::move(line), kInk, width, 0});
  drawing.add(Polygon{{tip, corner(0.42), corner(-0.42)}, {kInk, {}, {}, {}}});
}

void add_number(Drawing& drawing, Point at, double value) {
  char text[16];
  std::snprintf(text, sizeof text, "%.2f", value);
  drawing.add(Polygon{rectangle({at.x - 15, at.y - 9}, 30, 17), {kWhite, {}, {}, {}}});
  drawing.add(Text{{at.x, at.y + 4.5}, text, 13, kInk, Align::kCentre, false, false});
}

/// States evenly round a circle, the first on top.
class ChainView {
 public:
  ChainView(const TransitionMatrix& chain, const std::vector<Drawing>& pictures) : chain_(chain), pictures_(pictures) {
    double cell = 0;
    for (const Drawing& picture : pictures) cell = std::max(cell, std::hypot(picture.width, picture.height));
    const int num = chain.num_states();
    node_ = 0.5 * cell + 4;
    loop_ = 0.36 * node_;
    const double round = num == 1 ? 0 : std::max(1.7 * node_, 1.5 * node_ / std::sin(pi / num));
    const double half = round + node_ + 2 * loop_ + 14;
    drawing_ = {2 * half, 2 * half, kWhite, {}};
    for (int k = 0; k < num; ++k) {
      const double turn = 2 * pi * k / num - pi / 2;
      centres_.push_back({half + round * std::cos(turn), half + round * std::sin(turn)});
      outward_.push_back(turn);
    }
  }

  Drawing draw(double least) {
    for (int i = 0; i < chain_.num_states(); ++i)
      for (int j = 0; j < chain_.num_states(); ++j)
        if (const double probability = chain_.probability(i, j); probability >= least)
          i == j ? draw_loop(i, probability) : draw_step(i, j, probability);
    for (std::size_t k = 0; k < centres_.size(); ++k) {
      drawing_.add(Polyline{circle(centres_[k], node_, 0), kFaintInk, 1.4, 0});
      append(drawing_, pictures_[k], {centres_[k].x - pictures_[k].width / 2, centres_[k].y - pictures_[k].height / 2});
    }
    return std::move(drawing_);
  }

 private:
  static double width_of(double probability) { return 0.8 + 3 * probability; }

  void draw_step(int from, int to, double probability) {
    const Point a = centres_[static_cast<std::size_t>(from)], b = centres_[static_cast<std::size_t>(to)];
    const std::vector<Point> line = between_discs(arc(a, b, 0.16), a, b, node_ + 2);
    add_arrow(drawing_, line, width_of(probability));
    if (!line.empty()) add_number(drawing_, line[line.size() / 2], probability);
  }

  /// On the outer side.
  void draw_loop(int state, double probability) {
    const Point centre = centres_[static_cast<std::size_t>(state)];
    const double away = outward_[static_cast<std::size_t>(state)], reach = node_ + 0.7 * loop_;
    const Point middle{centre.x + reach * std::cos(away), centre.y + reach * std::sin(away)};
    add_arrow(drawing_, between_discs(circle(middle, loop_, away + pi), centre, centre, node_ + 2),
              width_of(probability));
    add_number(drawing_, {middle.x + loop_ * std::cos(away), middle.y + loop_ * std::sin(away)}, probability);
  }

  const TransitionMatrix& chain_;
  const std::vector<Drawing>& pictures_;
  Drawing drawing_;
  std::vector<Point> centres_;
  std::vector<double> outward_;  // angle from the middle of the picture
  double node_ = 0, loop_ = 0;   // radii
};

}  // namespace

Drawing chain_picture(const TransitionMatrix& chain, const std::vector<Drawing>& pictures, double least) {
  if (chain.num_states() < 1 || static_cast<std::size_t>(chain.num_states()) != pictures.size())
    throw InvalidInput("the picture of a chain needs one picture for each of its " +
                       std::to_string(chain.num_states()) + " states");
  return ChainView(chain, pictures).draw(least);
}

}  // namespace motex
