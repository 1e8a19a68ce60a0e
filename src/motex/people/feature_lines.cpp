// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/feature_lines.h"

#include <algorithm>
#include <cmath>

namespace motex {
namespace {

constexpr int kEdgeFrames = 5;
constexpr double kFixed = 0.02;       // of the box's height
constexpr int kPieces = 32;           // round the outline
constexpr double kFarthest = 0.12;    // of the height: pieces farther apart do not belong together
constexpr double kFarthestTip = 0.2;  // of the height
constexpr double kAxis = 0.1;         // of the height: length of outline from a tip to where its axis begins
constexpr double kLeastCosine = 0.5;  // of the angle between two lines of a pair
constexpr double kMostStretch = 2;

enum Side { kLeft, kTop, kRight, kBottom };

double edge(const BoundingBox& box, int side) {
  return side == kLeft ? box.left : side == kTop ? box.top : side == kRight ? box.right : box.bottom;
}

/// The side of the box as a line, at its place in the film.
FeatureLine line_along(const BoundingBox& box, int side, const Placement& placement) {
  const auto x = [&](double place) { return placement.scale * place + placement.x; };
  const auto y = [&](double place) { return placement.scale * place + placement.y; };
  if (side == kLeft || side == kRight) return {x(edge(box, side)), y(box.top), x(edge(box, side)), y(box.bottom)};
  return {x(box.left), y(edge(box, side)), x(box.right), y(edge(box, side))};
}

bool is_fixed(const PeopleTexture& texture, int frame, int side) {
  const auto take = std::find_if(texture.takes.begin(), texture.takes.end(), [&](const Take& one) {
    return frame >= one.frames.start && frame < one.frames.end();
  });
  if (take == texture.takes.end()) return false;
  const BoundingBox& box = texture.silhouettes[static_cast<std::size_t>(frame)].box;
  double farthest = 0;
  const int first = std::max(take->frames.start, frame - kEdgeFrames);
  const int last = std::min(take->frames.end() - 1, frame + kEdgeFrames);
  for (int f = first; f <= last; ++f) {
    const Silhouette& silhouette = texture.silhouettes[static_cast<std::size_t>(f)];
    if (silhouette.empty()) return false;
    farthest = std::max(farthest, std::abs(edge(silhouette.box, side) - edge(box, side)));
  }
  return farthest <= kFixed * box.height();
}

std::vector<FeatureLinePair> edges(const PeopleTexture& texture, const PlacedFrame& a, const PlacedFrame& b,
                                   bool only_fixed) {
  const BoundingBox& box_a = texture.silhouettes[static_cast<std::size_t>(a.frame)].box;
  const BoundingBox& box_b = texture.silhouettes[static_cast<std::size_t>(b.frame)].box;
  std::vector<FeatureLinePair> lines;
  if (box_a.empty() || box_b.empty()) return lines;
  for (const int side : {kLeft, kTop, kRight, kBottom})
    if (!only_fixed || (is_fixed(texture, a.frame, side) && is_fixed(texture, b.frame, side)))
      lines.push_back({line_along(box_a, side, a.placement), line_along(box_b, side, b.placement)});
  return lines;
}

double distance(const OutlinePoint& a, const OutlinePoint& b) { return std::hypot(a.x - b.x, a.y - b.y); }

FeatureLine line_of(const OutlinePoint& p, const OutlinePoint& q) { return {p.x, p.y, q.x, q.y}; }

/// Neither turned nor stretched too much to be the same thing.
bool agree(const FeatureLinePair& pair) {
  const double a = pair.a.length(), b = pair.b.length();
  if (a < 2 || b < 2 || a > kMostStretch * b || b > kMostStretch * a) return false;
  const double dot =
      (pair.a.qx - pair.a.px) * (pair.b.qx - pair.b.px) + (pair.a.qy - pair.a.py) * (pair.b.qy - pair.b.py);
  return dot >= kLeastCosine * a * b;
}

/// From the middle between the outline's two sides to the tip.
FeatureLine axis_of(const Outline& outline, int tip) {
  const int reach = std::max(2, static_cast<int>(std::lround(kAxis * outline.height / outline.step)));
  const OutlinePoint &before = outline.point(tip - reach), &after = outline.point(tip + reach);
  const OutlinePoint& end = outline.point(tip);
  return {(before.x + after.x) / 2, (before.y + after.y) / 2, end.x, end.y};
}

}  // namespace

std::vector<FeatureLinePair> fixed_edges(const PeopleTexture& texture, const PlacedFrame& a, const PlacedFrame& b) {
  return edges(texture, a, b, true);
}

std::vector<FeatureLinePair> box_edges(const PeopleTexture& texture, const PlacedFrame& a, const PlacedFrame& b) {
  return edges(texture, a, b, false);
}

std::vector<std::array<int, 2>> matched_tips(const Outline& a, const Outline& b, const std::vector<double>& places) {
  std::vector<std::array<int, 2>> pairs;
  const int m = b.size();
  for (const int tip : a.tips) {
    const double place = places[static_cast<std::size_t>(tip)];
    int best = -1;
    double closest = 0.05 * m;  // of the outline: farther along it is another tip
    for (const int other : b.tips) {
      const double apart = std::remainder(place - other, m);
      if (std::abs(apart) < closest) closest = std::abs(apart), best = other;
    }
    if (best >= 0 && distance(a.point(tip), b.point(best)) <= kFarthestTip * std::max(a.height, b.height))
      pairs.push_back({tip, best});
  }
  return pairs;
}

std::vector<FeatureLinePair> outline_lines(const PlacedSprite& a, const PlacedSprite& b) {
  const Outline outline_a = outline_of(a), outline_b = outline_of(b);
  const std::vector<double> places = match_outlines(outline_a, outline_b);
  std::vector<FeatureLinePair> lines;
  if (places.empty()) return lines;
  const double farthest = kFarthest * std::max(outline_a.height, outline_b.height);
  const int n = outline_a.size();
  const auto partner = [&](int i) {
    return point_between(outline_b, places[static_cast<std::size_t>(i % n)] + (i >= n ? outline_b.size() : 0));
  };
  for (int piece = 0; piece < kPieces; ++piece) {
    const int first = piece * n / kPieces, last = (piece + 1) * n / kPieces;
    const OutlinePoint p = partner(first), q = partner(last);
    if (distance(outline_a.point(first), p) > farthest || distance(outline_a.point(last), q) > farthest) continue;
    const FeatureLinePair pair{line_of(outline_a.point(first), outline_a.point(last)), line_of(p, q)};
    if (agree(pair)) lines.push_back(pair);
  }
  for (const auto& [tip_a, tip_b] : matched_tips(outline_a, outline_b, places)) {
    const FeatureLinePair pair{axis_of(outline_a, tip_a), axis_of(outline_b, tip_b)};
    if (agree(pair)) lines.push_back(pair);
  }
  return lines;
}

}  // namespace motex
