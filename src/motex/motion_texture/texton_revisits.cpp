// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/texton_revisits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace motex {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kCutCost = 0.5, kAwayCost = 0.5;
constexpr double kShortestVisitSecs = 0.4, kShortestCutSecs = 0.15, kSurroundingsSecs = 0.1;

/// First and last row of the example that each row belongs to.
struct Bounds {
  std::vector<Index> begin, end;
};

Bounds bounds_of(const RevisitSource& source) {
  Bounds bounds;
  const Index rows = source.rows.rows();
  for (std::size_t k = 0; k < source.starts.size(); ++k) {
    const Index end = k + 1 < source.starts.size() ? source.starts[k + 1] : rows;
    for (Index r = source.starts[k]; r < end; ++r)
      bounds.begin.push_back(source.starts[k]), bounds.end.push_back(end - 1);
  }
  return bounds;
}

/// δ of all pairs of rows: squared distances, averaged along their diagonals.
FrameMatrix surroundings_distances(const FrameMatrix& rows, const Bounds& bounds, Index reach) {
  const Index n = rows.rows();
  const Vector squares = rows.rowwise().squaredNorm();
  FrameMatrix frame = -2 * rows * rows.transpose();
  frame.colwise() += squares;
  frame.rowwise() += squares.transpose();
  FrameMatrix out(n, n);
  for (Index a = 0; a < n; ++a)
    for (Index b = 0; b < n; ++b) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      const Index before = std::min({reach, a - bounds.begin[i], b - bounds.begin[j]});
      const Index after = std::min({reach, bounds.end[i] - a, bounds.end[j] - b});
      double sum = 0;
      for (Index k = -before; k <= after; ++k) sum += frame(a + k, b + k);
      out(a, b) = std::sqrt(std::max(0.0, sum / static_cast<double>(before + after + 1)));
    }
  return out;
}

}  // namespace

RevisitPlanner::RevisitPlanner(const RevisitSource& source, double tau, double frame_time_secs, Index wanted_steps) {
  const auto frames = [&](double secs) { return std::max<Index>(2, std::lround(secs / frame_time_secs)); };
  const Index rows = source.rows.rows(), nearest = frames(kShortestCutSecs);
  Bounds bounds = bounds_of(source);
  last_ = bounds.end[0] - 1;
  min_steps_ = std::min(frames(kShortestVisitSecs), std::max<Index>(2, std::min(last_, wanted_steps) / 3));
  const double mean = source.speeds.head(last_).mean();
  speed_ = mean > 0 ? Vector(source.speeds / mean) : Vector(Vector::Ones(rows));
  excess_ = speed_.array() - 1;
  distances_ = surroundings_distances(source.rows, bounds, frames(kSurroundingsSecs));
  costs_ = FrameMatrix::Constant(rows, rows, kNever);
  begin_ = bounds.begin;
  for (Index a = 0; a < rows; ++a)
    for (Index b = 0; b < rows; ++b) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      const bool is_away = begin_[i] != begin_[j];
      if (a == bounds.end[i] || b == bounds.end[j] || (!is_away && std::abs(a - b) < nearest)) continue;
      const double far = distances_(a, b) / tau;
      costs_(a, b) = kCutCost + far * far + (is_away ? kAwayCost : 0);
    }
  for (Index b = 0; b < rows; ++b)
    if (b + min_steps_ < bounds.end[static_cast<std::size_t>(b)]) landings_.push_back(b);
}

/// H and G over (steps, row), and where each came from.
struct RevisitPlanner::Table {
  Table(Index rows, Index num_steps, double favour)
      : lambda(favour),
        walking(FrameMatrix::Constant(num_steps + 1, rows, kNever)),
        landed(FrameMatrix::Constant(num_steps + 1, rows, kNever)),
        began(static_cast<std::size_t>(rows * (num_steps + 1)), -1),
        cut_from(static_cast<std::size_t>(rows * (num_steps + 1)), -1) {}
  std::size_t at(Index steps, Index row) const { return static_cast<std::size_t>(steps * walking.cols() + row); }

  double lambda;
  FrameMatrix walking, landed;         ///< H, G
  std::vector<Index> began, cut_from;  ///< first row of the visit; the row a of the cut
};

/// H of m steps.
void RevisitPlanner::walk(Table& table, Index m) const {
  for (Index r = min_steps_; r < speed_.size(); ++r) {
    double& best = table.walking(m, r);
    const Index first = begin_[static_cast<std::size_t>(r)], b = r - min_steps_;
    if (r > first && table.walking(m - 1, r - 1) < kNever) {
      best = table.walking(m - 1, r - 1) + table.lambda * excess_[r - 1];
      table.began[table.at(m, r)] = table.began[table.at(m - 1, r - 1)];
    }
    if (b < first || !(table.landed(m - min_steps_, b) < kNever)) continue;
    const double fresh = table.landed(m - min_steps_, b) + table.lambda * excess_.segment(b, min_steps_).sum();
    if (fresh < best) best = fresh, table.began[table.at(m, r)] = b;
  }
}

/// G of m steps.
void RevisitPlanner::cut(Table& table, Index m) const {
  for (Index a = 0; a < speed_.size(); ++a) {
    const double walked = table.walking(m, a);
    if (!(walked < kNever)) continue;
    for (const Index b : landings_) {
      const double cost = walked + costs_(a, b);
      if (cost < table.landed(m, b)) table.landed(m, b) = cost, table.cut_from[table.at(m, b)] = a;
    }
  }
}

std::vector<RevisitPlanner::Way> RevisitPlanner::ways(Index fewest, Index most, double lambda) const {
  Table table(speed_.size(), most, lambda);
  table.landed(0, 0) = 0;
  for (Index m = min_steps_; m <= most; ++m) {
    walk(table, m);
    cut(table, m);
  }
  std::vector<Way> ways;
  for (Index m = std::max<Index>(1, fewest); m <= most; ++m)
    if (table.walking(m, last_) < kNever) ways.push_back(trace(table, m));
  return ways;
}

RevisitPlanner::Way RevisitPlanner::trace(const Table& table, Index steps) const {
  Way way;
  way.num_steps = steps;
  Index row = last_, m = steps;
  double sum = 0;
  while (true) {
    const Index first = table.began[table.at(m, row)];
    way.visits.push_back({first, row});
    sum += speed_.segment(first, row - first).sum();
    m -= row - first;
    if (first == 0 && m == 0) break;
    row = table.cut_from[table.at(m, first)];
    way.cost += costs_(row, first);
    way.largest_cut = std::max(way.largest_cut, distances_(row, first));
  }
  std::reverse(way.visits.begin(), way.visits.end());
  way.speed = sum / static_cast<double>(steps);
  return way;
}

}  // namespace motex
