// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/best_pairs.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace motex {
namespace {

class Groups {
 public:
  explicit Groups(int size) : parent_(static_cast<std::size_t>(size)) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int node) {
    while (at(node) != node) node = at(node) = at(at(node));
    return node;
  }
  void join(int a, int b) { at(find(a)) = find(b); }

 private:
  int& at(int node) { return parent_[static_cast<std::size_t>(node)]; }
  std::vector<int> parent_;
};

/// Rows and columns numbered within a group, gains as a dense table.
struct DenseGroup {
  std::vector<int> rows, columns;
  std::vector<double> gains;
};

/// Hungarian method with potentials: a shortest augmenting path for each row. Every row has a column of its own that
/// stands for staying alone (gain 0), so a complete assignment exists.
std::vector<int> solve(const DenseGroup& group) {
  const std::size_t num_rows = group.rows.size(), num_real = group.columns.size(), num_columns = num_real + num_rows;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto cost = [&](std::size_t row, std::size_t column) {
    if (column < num_real) return -group.gains[row * num_real + column];
    return column - num_real == row ? 0.0 : kInfinity;
  };
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<double> row_price(num_rows), column_price(num_columns + 1);
  std::vector<std::size_t> owner(num_columns + 1, kNone), way(num_columns + 1);
  for (std::size_t start = 0; start < num_rows; ++start) {
    std::vector<double> shortest(num_columns, kInfinity);
    std::vector<bool> done(num_columns + 1);
    std::size_t column = num_columns;
    owner[column] = start;
    do {
      done[column] = true;
      const std::size_t row = owner[column];
      double step = kInfinity;
      std::size_t next = kNone;
      for (std::size_t c = 0; c < num_columns; ++c) {
        if (done[c]) continue;
        const double reduced = cost(row, c) - row_price[row] - column_price[c];
        if (reduced < shortest[c]) {
          shortest[c] = reduced;
          way[c] = column;
        }
        if (shortest[c] < step) {
          step = shortest[c];
          next = c;
        }
      }
      for (std::size_t c = 0; c <= num_columns; ++c) {
        if (done[c]) {
          row_price[owner[c]] += step;
          column_price[c] -= step;
        } else {
          shortest[c] -= step;
        }
      }
      column = next;
    } while (owner[column] != kNone);
    for (; column != num_columns; column = way[column]) owner[column] = owner[way[column]];
  }
  std::vector<int> column_of(num_rows, -1);
  for (std::size_t c = 0; c < num_real; ++c)
    if (owner[c] != kNone && group.gains[owner[c] * num_real + c] > 0) column_of[owner[c]] = group.columns[c];
  return column_of;
}

int place_in(const std::vector<int>& sorted, int value) {
  return static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
}

void sort_unique(std::vector<int>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

std::vector<int> best_pairs(int num_rows, int num_columns, const std::vector<PairGain>& gains) {
  Groups groups(num_rows + num_columns);
  std::vector<PairGain> useful;
  for (const PairGain& pair : gains)
    if (pair.gain > 0 && pair.row >= 0 && pair.row < num_rows && pair.column >= 0 && pair.column < num_columns) {
      useful.push_back(pair);
      groups.join(pair.row, num_rows + pair.column);
    }
  std::stable_sort(useful.begin(), useful.end(),
                   [&](const PairGain& a, const PairGain& b) { return groups.find(a.row) < groups.find(b.row); });
  std::vector<int> column_of(static_cast<std::size_t>(num_rows), -1);
  for (std::size_t first = 0, end = 0; first < useful.size(); first = end) {
    DenseGroup group;
    for (end = first; end < useful.size() && groups.find(useful[end].row) == groups.find(useful[first].row); ++end) {
      group.rows.push_back(useful[end].row);
      group.columns.push_back(useful[end].column);
    }
    sort_unique(group.rows);
    sort_unique(group.columns);
    // Pairs that are not possible are worth less than staying alone.
    group.gains.assign(group.rows.size() * group.columns.size(), -1);
    for (std::size_t k = first; k < end; ++k) {
      const auto row = static_cast<std::size_t>(place_in(group.rows, useful[k].row));
      const auto column = static_cast<std::size_t>(place_in(group.columns, useful[k].column));
      double& gain = group.gains[row * group.columns.size() + column];
      gain = std::max(gain, useful[k].gain);
    }
    const std::vector<int> solution = solve(group);
    for (std::size_t k = 0; k < solution.size(); ++k) column_of[static_cast<std::size_t>(group.rows[k])] = solution[k];
  }
  return column_of;
}

}  // namespace motex
