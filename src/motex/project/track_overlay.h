// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "motex/image/image.h"
#include "motex/particles/track.h"

namespace motex {

/// Draws tracks over the frames of a clip: a ring of 2 · scale round each element and the trail of where it was, both
/// in the colour of its track (unit_colour), trails paling with age. Small pictures are magnified by a whole number, so
/// that rings do not hide what they stand around.
class TrackOverlay {
 public:
  /// width × height: of the clip, pixels. trail: frames. Tracks are copied.
  TrackOverlay(std::vector<Track> tracks, int width, int height, int trail = 20);

  int magnification() const { return magnification_; }
  int width() const { return width_ * magnification_; }
  int height() const { return height_ * magnification_; }
  /// The frame's picture (of the clip's size) with what is on it, width() × height(). Frames may be asked for in any
  /// order. Throws InvalidInput for another size.
  Image draw(const Image& picture, std::int64_t frame) const;

 private:
  std::vector<Track> tracks_;
  int width_, height_, trail_, magnification_;
};

}  // namespace motex
