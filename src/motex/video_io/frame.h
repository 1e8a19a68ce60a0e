// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "motex/image/image.h"
#include "motex/image/planes.h"

namespace motex {

/// One picture of a video with 8 bits a channel.
struct VideoFrame {
  Image image;           ///< sRGB, alpha not premultiplied
  std::int64_t idx = 0;  ///< from 0, in the order of display
  double time_secs = 0;  ///< since the first frame, from the file's time stamps
};

/// The same as floats: one plane (grey), three (R, G, B) or four (with alpha), in grey levels 0 … 255. What a 10 to
/// 16-bit file has between the levels is kept.
struct DeepVideoFrame {
  Planes planes;
  std::int64_t idx = 0;
  double time_secs = 0;
};

}  // namespace motex
