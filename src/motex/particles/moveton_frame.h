// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "motex/particles/base.h"

namespace motex {

/// One moveton in one frame: bases[first_base] is its core, the next num_bases − 1 are its coils.
struct Moveton {
  std::int64_t track = 0;  ///< number of its cable
  int species = -1;        ///< index of its template; −1 = a free base
  int pose = 0;            ///< state of the template
  double depth = 0;        ///< larger is farther; 0 where nothing is known of depth
  double vx = 0, vy = 0;   ///< pixels a frame
  std::size_t first_base = 0;
  std::size_t num_bases = 1;
};

/// All movetons of one frame, in the order in which they are drawn. Reused from frame to frame, so that nothing is
/// allocated.
struct MovetonFrame {
  std::int64_t frame = 0;
  std::vector<Moveton> movetons;
  std::vector<Base> bases;  ///< of all movetons, in pixels of the model's picture

  const Base& core_of(const Moveton& moveton) const { return bases[moveton.first_base]; }
  std::span<const Base> bases_of(const Moveton& moveton) const {
    return std::span(bases).subspan(moveton.first_base, moveton.num_bases);
  }
  void clear() {
    movetons.clear();
    bases.clear();
  }
};

/// Where movetons come from frame by frame: a learned clip, a synthesis, an edit of either, birds in 3-D. Never all
/// frames in memory.
class MovetonSource {
 public:
  virtual ~MovetonSource() = default;
  /// Fills in the next frame, numbered from 0; false at the end, which a source need not have.
  virtual bool next_frame(MovetonFrame& frame) = 0;
};

}  // namespace motex
