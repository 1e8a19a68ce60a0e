// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <string>
#include <string_view>

#include "motex/core/error.h"

namespace motex {

/// What long work needs from its caller. Copyable; every member may be left empty.
struct JobContext {
  /// Called from the calling thread only: name of the stage and share of the whole job done, 0 … 1, never falling.
  std::function<void(std::string_view stage, double fraction)> on_progress;
  /// One complete sentence a call; the job goes on.
  std::function<void(const std::string& message)> on_warning;
  /// Set to true (from any thread or a signal handler) to stop: the job throws Cancelled soon and leaves nothing
  /// behind.
  const std::atomic<bool>* cancel = nullptr;
  /// Threads to use; 0 = all cores. Results do not depend on it.
  int jobs = 0;

  void progress(std::string_view stage, double fraction) const {
    if (on_progress) on_progress(stage, fraction);
  }
  void warn(const std::string& message) const {
    if (on_warning) on_warning(message);
  }
  void check_cancelled() const {
    if (cancel != nullptr && cancel->load(std::memory_order_relaxed)) throw Cancelled();
  }
  /// For a part of the job: what it tells as 0 … 1 is from … to of the whole.
  JobContext part(double from, double to) const {
    JobContext out = *this;
    if (on_progress)
      out.on_progress = [whole = on_progress, from, to](std::string_view stage, double fraction) {
        whole(stage, from + (to - from) * std::clamp(fraction, 0.0, 1.0));
      };
    return out;
  }
};

}  // namespace motex
