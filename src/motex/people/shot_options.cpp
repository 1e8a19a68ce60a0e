// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/shot_options.h"

#include <algorithm>
#include <cmath>

namespace motex {

int min_shot_frames(const ShotOptions& options, double frames_per_sec) {
  return std::max(
      {2, options.transition_frames + 2, static_cast<int>(std::lround(options.min_shot_secs * frames_per_sec))});
}

}  // namespace motex
