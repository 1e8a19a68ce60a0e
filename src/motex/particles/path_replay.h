// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "motex/particles/cable.h"

namespace motex {

/// The steps of a cable that was observed, without end: step k leads from its frame k to the next one; before its first
/// and after its last frame they come again in reversed order. Directions are kept, so that speeds and directions are
/// those that were seen, however long it lasts.
class PathReplay {
 public:
  struct Step {
    double dx = 0, dy = 0;
  };

  /// Begins with step `first`. The cable has two frames at least, and must outlive it.
  explicit PathReplay(const Cable& cable, std::int64_t first = 0) : cable_(&cable), place_(first) {}

  /// So many frames more with the step that is next.
  void hold(std::int64_t frames) { held_ = frames; }
  Step next() {
    const Step step = step_at(place_);
    if (held_ > 0)
      --held_;
    else
      ++place_;
    return step;
  }
  Step peek() const { return step_at(place_); }
  Step mean() const {
    const auto steps = static_cast<double>(cable_->core.size() - 1);
    return {(cable_->core.back().x - cable_->core.front().x) / steps,
            (cable_->core.back().y - cable_->core.front().y) / steps};
  }
  Step step_at(std::int64_t k) const {
    const auto num = static_cast<std::int64_t>(cable_->core.size()) - 1;
    std::int64_t place = k % (2 * num);
    if (place < 0) place += 2 * num;
    if (place >= num) place = 2 * num - 1 - place;
    const Base &from = cable_->core[static_cast<std::size_t>(place)],
               &to = cable_->core[static_cast<std::size_t>(place) + 1];
    return {to.x - from.x, to.y - from.y};
  }

 private:
  const Cable* cable_;
  std::int64_t place_;
  std::int64_t held_ = 0;
};

}  // namespace motex
