// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace motex {

/// Which windows may be an action: enough happens in them, and they hold whatever they touch of what happens between
/// two idle stretches nearly whole or (not whole_only) little idleness beside.
class ActionWindows {
 public:
  /// active: frame by frame; what pauses for at most `shortest_pause` frames goes on.
  ActionWindows(std::vector<unsigned char> active, int shortest_pause);
  /// Frames from the middle of the window to the middle of what it touches of what happens.
  double off_centre(int start, int length) const;
  bool allow(int start, int length, bool whole_only, double least_active) const;

 private:
  static std::size_t at(int t) { return static_cast<std::size_t>(t); }
  std::vector<unsigned char> active_;
  std::vector<int> sums_, first_, last_;
};

}  // namespace motex
