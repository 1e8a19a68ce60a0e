// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "motex/core/error.h"
#include "motex/motion/clip.h"

namespace motex {

/// A streaming pass (FootFixer, FloorFixer) over a whole clip, in place. Throws InvalidInput for a pinned frame that
/// the clip has not.
template <typename Fixer>
void fix_whole_clip(Fixer& fixer, Clip& clip, std::span<const Index> pinned) {
  std::vector<std::uint8_t> is_pinned(static_cast<std::size_t>(clip.num_frames()), 0);
  for (const Index frame : pinned) {
    if (frame < 0 || frame >= clip.num_frames())
      throw InvalidInput("frame " + std::to_string(frame) + " cannot be pinned: " + clip.name + " has " +
                         std::to_string(clip.num_frames()));
    is_pinned[static_cast<std::size_t>(frame)] = 1;
  }
  Index out = 0;
  for (Index t = 0; t < clip.num_frames(); ++t) {
    fixer.push(clip, t, is_pinned[static_cast<std::size_t>(t)] != 0);
    while (fixer.pop(clip, out)) ++out;
  }
  fixer.finish();
  while (fixer.pop(clip, out)) ++out;
}

}  // namespace motex
