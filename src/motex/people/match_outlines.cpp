// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "motex/people/outline.h"

namespace motex {
namespace {

constexpr double kReach = 0.08;    // of the height: a distance that costs 1
constexpr double kDirection = 1;   // costs opposite directions twice this
constexpr double kColour = 60;     // grey levels that cost 1
constexpr double kMostColour = 2;  // light and folds change
constexpr double kStay = 0.25;     // extra for going on along one outline alone
constexpr int kNumStarts = 4;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

double difference(const OutlinePoint& a, const OutlinePoint& b, double reach) {
  const double dx = a.x - b.x, dy = a.y - b.y;
  double colour = 0;
  for (std::size_t c = 0; c < 3; ++c) colour += (a.colour[c] - b.colour[c]) * (a.colour[c] - b.colour[c]);
  return (dx * dx + dy * dy) / (reach * reach) + kDirection * (1 - a.normal_x * b.normal_x - a.normal_y * b.normal_y) +
         std::min(kMostColour, colour / (kColour * kColour));
}

struct Way {
  double cost = std::numeric_limits<double>::infinity();
  std::vector<double> places;  // of each point of a, from point `start` on
  int start = 0;
};

/// Dynamic time warping of a, from point `start` once round, to b, from point `entry` once round.
class Warping {
 public:
  Warping(const Outline& a, const Outline& b) : a_(a), b_(b), differences_(at(a.size()) * at(b.size())) {
    const double reach = kReach * std::max(a.height, b.height);
    for (int i = 0; i < a.size(); ++i)
      for (int j = 0; j < b.size(); ++j) differences_[index(i, j)] = difference(a.point(i), b.point(j), reach);
  }

  int best_partner(int i) const {
    const auto row = differences_.begin() + static_cast<std::ptrdiff_t>(index(i, 0));
    return static_cast<int>(std::min_element(row, row + b_.size()) - row);
  }

  Way way_from(int start, int entry) const {
    const int n = a_.size(), m = b_.size();
    std::vector<double> cost((at(n) + 1) * (at(m) + 1), std::numeric_limits<double>::infinity());
    std::vector<std::uint8_t> step(cost.size(), 0);
    const auto cell = [&](int i, int j) { return at(i) * (at(m) + 1) + at(j); };
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= m; ++j) {
        const double here = differences_[index((start + i) % n, (entry + j) % m)];
        if (i == 0 && j == 0) {
          cost[0] = here;
          continue;
        }
        double best = std::numeric_limits<double>::infinity();
        const auto try_step = [&](std::uint8_t kind, double before) {
          if (before < best) best = before, step[cell(i, j)] = kind;
        };
        if (i > 0 && j > 0) try_step(0, cost[cell(i - 1, j - 1)]);
        if (i > 0) try_step(1, cost[cell(i - 1, j)] + kStay);
        if (j > 0) try_step(2, cost[cell(i, j - 1)] + kStay);
        cost[cell(i, j)] = best + here;
      }
    }
    return {cost[cell(n, m)], traced(step, start, entry), start};
  }

 private:
  std::size_t index(int i, int j) const { return at(i) * at(b_.size()) + at(j); }

  /// The middle of the places that each point of a is joined with.
  std::vector<double> traced(const std::vector<std::uint8_t>& step, int start, int entry) const {
    const int n = a_.size(), m = b_.size();
    std::vector<double> first(at(n), 0), last(at(n), -1);
    for (int i = n, j = m;;) {
      if (i < n) {
        first[at(i)] = j;
        if (last[at(i)] < 0) last[at(i)] = j;
      }
      if (i == 0 && j == 0) break;
      const std::uint8_t kind = step[at(i) * (at(m) + 1) + at(j)];
      i -= kind != 2 ? 1 : 0;
      j -= kind != 1 ? 1 : 0;
    }
    std::vector<double> places(at(n));
    for (int i = 0; i < n; ++i) {
      const double place = (first[at(i)] + last[at(i)]) / 2 + entry;
      const int point = (start + i) % n;
      places[at(point)] = place - (start + i >= n ? m : 0);
    }
    return places;
  }

  const Outline& a_;
  const Outline& b_;
  std::vector<double> differences_;
};

}  // namespace

std::vector<double> match_outlines(const Outline& a, const Outline& b) {
  if (a.points.empty() || b.points.empty()) return {};
  const Warping warping(a, b);
  Way best;
  for (int k = 0; k < kNumStarts; ++k) {
    const int start = k * a.size() / kNumStarts;
    Way way = warping.way_from(start, warping.best_partner(start));
    if (way.cost < best.cost) best = std::move(way);
  }
  return best.places;
}

}  // namespace motex
