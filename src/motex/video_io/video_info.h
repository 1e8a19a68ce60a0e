// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace motex {

/// What a file says about its video before it is read through.
struct VideoInfo {
  std::string name;          ///< for messages: the path as given
  std::string container;     ///< "mp4", "matroska", "images", "tiff stack", …
  std::string codec;         ///< "h264", …
  std::string pixel_format;  ///< as the codec stores it: "yuv420p10le", …
  int width = 0;             ///< of the frames that are handed out: rotation done
  int height = 0;
  int num_channels = 3;        ///< 1 = grey, 3, 4 = with alpha
  int bit_depth = 8;           ///< of a channel in the file
  bool coarse_colour = false;  ///< colours are stored at half the resolution of the light, both ways (4:2:0)
  int rotation_deg = 0;        ///< clockwise, asked for by the file and done: 0, 90, 180, 270
  bool mirrored = false;
  double pixel_aspect = 1;           ///< width of a pixel / its height; frames are handed out unstretched
  double frames_per_sec = 0;         ///< average as the file says; 0 = unknown
  std::int64_t num_frames_said = 0;  ///< by the header, which may lie; 0 = unknown
  double duration_secs = 0;          ///< as the header says; 0 = unknown
  double start_secs = 0;             ///< time stamp of the first frame, whose time_secs is 0
  bool has_sound = false;
};

}  // namespace motex
