// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/action_windows.h"

#include <algorithm>
#include <utility>

namespace motex {
namespace {

constexpr double kLeastActiveCut = 0.6;  // of a window that cuts what happens in two
constexpr double kWhole = 0.85;

}  // namespace

ActionWindows::ActionWindows(std::vector<unsigned char> active, int shortest_pause) : sums_(active.size() + 1, 0) {
  const int size = static_cast<int>(active.size());
  int last_active = -size;
  for (int t = 0; t < size; ++t) {  // what pauses for less than that goes on
    if (active[at(t)] == 0) continue;
    if (t - last_active <= shortest_pause) std::fill(active.begin() + last_active, active.begin() + t, 1);
    last_active = t;
  }
  for (std::size_t t = 0; t < active.size(); ++t) sums_[t + 1] = sums_[t] + active[t];
  first_.resize(active.size() + 1);
  last_.resize(active.size() + 1);
  for (int t = 0; t < size; ++t) first_[at(t)] = t > 0 && active[at(t - 1)] != 0 ? first_[at(t - 1)] : t;
  for (int t = size; t-- > 0;) last_[at(t)] = t + 1 < size && active[at(t + 1)] != 0 ? last_[at(t + 1)] : t + 1;
  active_ = std::move(active);
}

double ActionWindows::off_centre(int start, int length) const {
  const int end = start + length;
  int from = start, to = end;
  while (from < end && active_[at(from)] == 0) ++from;
  while (to > from && active_[at(to - 1)] == 0) --to;
  if (from == to) return 0;
  return (first_[at(from)] + last_[at(to - 1)]) / 2.0 - (start + end) / 2.0;
}

bool ActionWindows::allow(int start, int length, bool whole_only, double least_active) const {
  const int inside = sums_[at(start + length)] - sums_[at(start)];
  if (inside < least_active * length) return false;
  if (!whole_only && inside >= kLeastActiveCut * length) return true;
  const int from = active_[at(start)] != 0 ? first_[at(start)] : start;
  const int to = active_[at(start + length - 1)] != 0 ? last_[at(start + length - 1)] : start + length;
  return inside >= kWhole * (sums_[at(to)] - sums_[at(from)]);
}

}  // namespace motex
