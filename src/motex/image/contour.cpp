// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/contour.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace motex {
namespace {

constexpr std::int64_t kNone = -1;

/// The plane with one pixel of "outside" all round, and for each grid edge that the outline crosses the edge that it
/// crosses next. Edge 2p goes from grid point p to its right neighbour, 2p + 1 to the one below.
class Crossings {
 public:
  Crossings(const Plane& plane, float level)
      : width_(plane.width + 2), height_(plane.height + 2), level_(level), plane_(plane) {
    next_.assign(2 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), kNone);
    for (int y = 0; y + 1 < height_; ++y)
      for (int x = 0; x + 1 < width_; ++x) link_cell(x, y);
  }

  std::vector<Contour> follow() {
    std::vector<Contour> found;
    for (std::size_t start = 0; start < next_.size(); ++start) {
      if (next_[start] == kNone) continue;
      Contour& contour = found.emplace_back();
      for (auto edge = static_cast<std::int64_t>(start); next_[static_cast<std::size_t>(edge)] != kNone;) {
        contour.push_back(point_on(edge));
        const std::int64_t from = edge;
        edge = next_[static_cast<std::size_t>(from)];
        next_[static_cast<std::size_t>(from)] = kNone;
      }
    }
    return found;
  }

 private:
  bool on_border(int x, int y) const { return x == 0 || y == 0 || x == width_ - 1 || y == height_ - 1; }
  /// Beyond the border as far below the level as the border pixel is above it: the line passes half a pixel outside.
  float at(int x, int y) const {
    if (!on_border(x, y)) return plane_.at(x - 1, y - 1) - level_;
    const int inner_x = x == 0 ? 0 : x == width_ - 1 ? plane_.width - 1 : x - 1;
    const int inner_y = y == 0 ? 0 : y == height_ - 1 ? plane_.height - 1 : y - 1;
    const float inside = plane_.at(inner_x, inner_y) - level_;
    return inside >= 0 ? -inside - 1e-6F : inside;
  }
  bool inside(int x, int y) const { return at(x, y) >= 0; }
  std::int64_t edge(int x, int y, bool down) const { return 2 * (std::int64_t{y} * width_ + x) + (down ? 1 : 0); }

  void link(std::int64_t from, std::int64_t to) { next_[static_cast<std::size_t>(from)] = to; }

  /// Walks round the cell clockwise: where it leaves the inside a piece of outline starts or ends.
  void link_cell(int x, int y) {
    const std::array<bool, 4> in{inside(x, y), inside(x + 1, y), inside(x + 1, y + 1), inside(x, y + 1)};
    const std::array<std::int64_t, 4> edges{edge(x, y, false), edge(x + 1, y, true), edge(x, y + 1, false),
                                            edge(x, y, true)};
    std::array<int, 2> leaving{}, entering{};
    int num = 0, num_entering = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool here = in[k], there = in[(k + 1) % 4];
      if (here && !there) leaving[static_cast<std::size_t>(num++)] = static_cast<int>(k);
      if (!here && there) entering[static_cast<std::size_t>(num_entering++)] = static_cast<int>(k);
    }
    const auto join = [&](int from, int to) {
      link(edges[static_cast<std::size_t>(to)], edges[static_cast<std::size_t>(from)]);  // the inside on the right
    };
    if (num == 1) join(entering[0], leaving[0]);
    if (num != 2) return;
    // A saddle: the middle says whether the two inside corners are connected.
    const bool connected = at(x, y) + at(x + 1, y) + at(x + 1, y + 1) + at(x, y + 1) >= 0;
    for (const int from : entering)
      for (const int to : leaving) {
        const int ahead = (to - from + 4) % 4;  // 1: round one inside corner, 3: round the outside corner before
        if (ahead == (connected ? 3 : 1)) join(from, to);
      }
  }

  ContourPoint point_on(std::int64_t idx) const {
    const auto x = static_cast<int>((idx / 2) % width_), y = static_cast<int>((idx / 2) / width_);
    const bool down = (idx & 1) != 0;
    const float a = at(x, y), b = down ? at(x, y + 1) : at(x + 1, y);
    const double share = a == b ? 0.5 : static_cast<double>(a) / static_cast<double>(a - b);
    return {x - 1 + (down ? 0 : share), y - 1 + (down ? share : 0)};
  }

  int width_, height_;
  float level_;
  const Plane& plane_;
  std::vector<std::int64_t> next_;
};

}  // namespace

std::vector<Contour> contours(const Plane& plane, float level) {
  if (plane.values.empty()) return {};
  return Crossings(plane, level).follow();
}

double signed_area(const Contour& contour) {
  double twice = 0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const ContourPoint a = contour[i], b = contour[(i + 1) % contour.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

}  // namespace motex
