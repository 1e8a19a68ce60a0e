// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/best_pairs.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace motex {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Hungarian method on the pairs that exist: for each row a shortest augmenting path (Dijkstra on costs reduced by the
/// prices), which ends at a free column or where some row on it is better left alone (gain 0). Only what lies nearer
/// than its end is visited.
class SparseAssignment {
 public:
  SparseAssignment(int num_rows, int num_columns, const std::vector<PairGain>& gains)
      : first_(static_cast<std::size_t>(num_rows) + 1),
        column_of_(static_cast<std::size_t>(num_rows), -1),
        row_price_(static_cast<std::size_t>(num_rows)),
        row_of_(static_cast<std::size_t>(num_columns), -1),
        from_(static_cast<std::size_t>(num_columns), -1),
        column_price_(static_cast<std::size_t>(num_columns)),
        distance_(static_cast<std::size_t>(num_columns), kInfinity) {
    const auto is_useful = [&](const PairGain& pair) {
      return pair.gain > 0 && pair.row >= 0 && pair.row < num_rows && pair.column >= 0 && pair.column < num_columns;
    };
    for (const PairGain& pair : gains)
      if (is_useful(pair)) ++first_[static_cast<std::size_t>(pair.row) + 1];
    for (std::size_t row = 1; row < first_.size(); ++row) first_[row] += first_[row - 1];
    edges_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const PairGain& pair : gains)
      if (is_useful(pair)) edges_[next[static_cast<std::size_t>(pair.row)]++] = {pair.column, -pair.gain};
  }

  std::vector<int> solve() {
    for (int row = 0; row < static_cast<int>(column_of_.size()); ++row) assign(row);
    return std::move(column_of_);
  }

 private:
  struct Edge {
    int column = 0;
    double cost = 0;
  };
  template <typename T>
  static T& at(std::vector<T>& values, int k) {
    return values[static_cast<std::size_t>(k)];
  }

  void assign(int start) {
    double price = 0;
    for (std::size_t k = at(first_, start); k < at(first_, start + 1); ++k)
      price = std::min(price, edges_[k].cost - at(column_price_, edges_[k].column));
    at(row_price_, start) = price;
    queue_ = {};
    touched_.clear();
    done_.clear();
    double end_distance = kInfinity;
    int left_alone = -1, free_column = -1, row = start;
    for (double distance = 0;;) {
      if (distance - at(row_price_, row) < end_distance) {
        end_distance = distance - at(row_price_, row);
        left_alone = row;
      }
      relax(row, distance);
      int column = -1;
      while (!queue_.empty() && column < 0) {
        const auto [there, candidate] = queue_.top();
        if (there > end_distance) break;
        queue_.pop();
        if (there <= at(distance_, candidate)) column = candidate;
        distance = there;
      }
      if (column < 0) break;
      if (at(row_of_, column) < 0) {
        free_column = column;
        end_distance = distance;
        break;
      }
      done_.push_back(column);
      row = at(row_of_, column);
    }
    reprice(start, end_distance);
    augment(start, free_column, left_alone);
    for (const int column : touched_) at(distance_, column) = kInfinity;
  }

  void relax(int row, double distance) {
    for (std::size_t k = at(first_, row); k < at(first_, row + 1); ++k) {
      const Edge& edge = edges_[k];
      const double there = distance + std::max(0.0, edge.cost - at(row_price_, row) - at(column_price_, edge.column));
      if (there >= at(distance_, edge.column)) continue;
      if (at(distance_, edge.column) == kInfinity) touched_.push_back(edge.column);
      at(distance_, edge.column) = there;
      at(from_, edge.column) = row;
      queue_.emplace(there, edge.column);
    }
  }

  void reprice(int start, double end_distance) {
    at(row_price_, start) += end_distance;
    for (const int column : done_) {
      const double change = end_distance - at(distance_, column);
      at(column_price_, column) -= change;
      at(row_price_, at(row_of_, column)) += change;
    }
  }

  void augment(int start, int free_column, int left_alone) {
    int column = free_column;
    if (column < 0) {
      column = at(column_of_, left_alone);
      at(column_of_, left_alone) = -1;
      if (left_alone == start) return;
    }
    for (int row = at(from_, column);; row = at(from_, column)) {
      at(row_of_, column) = row;
      std::swap(at(column_of_, row), column);
      if (row == start) break;
    }
  }

  std::vector<std::size_t> first_;  // edge of each row
  std::vector<Edge> edges_;
  std::vector<int> column_of_;
  std::vector<double> row_price_;
  std::vector<int> row_of_, from_;
  std::vector<double> column_price_, distance_;
  std::vector<int> touched_, done_;
  using Reached = std::pair<double, int>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue_;
};

}  // namespace

std::vector<int> best_pairs(int num_rows, int num_columns, const std::vector<PairGain>& gains) {
  return SparseAssignment(num_rows, num_columns, gains).solve();
}

}  // namespace motex
