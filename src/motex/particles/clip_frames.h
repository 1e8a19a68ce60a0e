// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/image/planes.h"

namespace motex {

/// A short video in memory: what movetons are learned from. Geometry is found on the luma, colours are fitted after.
struct ClipFrames {
  int width = 0, height = 0;
  double frames_per_sec = 25;
  std::vector<Plane> luma;    ///< one a frame, grey levels 0 … 255
  std::vector<Image> colour;  ///< one a frame; empty when every frame is grey

  int num_frames() const { return static_cast<int>(luma.size()); }
  int num_planes() const { return colour.empty() ? 1 : 3; }
};

}  // namespace motex
