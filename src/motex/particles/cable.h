// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/particles/base.h"

namespace motex {

/// A moveton followed from birth to death: C[t_b, t_e] of [TM02] eq. 5. The core is the strong base that is tracked;
/// the coils are the weaker bases around it, as many in every frame of the cable. No core base outside the picture's
/// surroundings: those are drawn where they reach in. Angles are unwrapped along a cable (not folded into [0, π)).
struct Cable {
  std::int64_t first_frame = 0;          ///< t_b
  std::vector<Base> core;                ///< one a frame, image coordinates
  std::vector<std::vector<Base>> coils;  ///< each as long as `core`, image coordinates
  int species = -1;                      ///< index of its template in the model; −1 = none: a free base
  std::vector<int> poses;                ///< state of the template in each frame (wings); empty = it has one only

  std::int64_t num_frames() const { return static_cast<std::int64_t>(core.size()); }
  std::int64_t end_frame() const { return first_frame + num_frames(); }  ///< t_e + 1
  bool covers(std::int64_t frame) const { return frame >= first_frame && frame < end_frame(); }
  const Base& at(std::int64_t frame) const { return core[static_cast<std::size_t>(frame - first_frame)]; }
};

/// Largest grey-level deviation of the base from its background: coefficient (of that plane) × ψ(0) / ‖ψ‖ for even
/// kinds; for Gsin at its crest. Sign kept.
double peak_amplitude(const Base& base, int plane = 0);
/// The coefficient that gives that peak.
double coefficient_of_peak(const Base& base, double amplitude);

}  // namespace motex
