// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/image/planes.h"
#include "motex/video_io/libav_handles.h"

namespace motex::libav {

/// How stored pixels are to be turned for showing: first mirrored left to right, then turned clockwise.
struct Orientation {
  bool mirrored = false;
  int quarter_turns = 0;  ///< 0 … 3
  friend bool operator==(const Orientation&, const Orientation&) = default;
};

/// From the 3 × 3 display matrix of the file (null = none).
Orientation orientation_of(const void* display_matrix);

/// Turns decoded frames into RGB. Colour matrix, range and siting of colours come from the frame; where it is silent,
/// BT.709 from 720 rows on, else BT.601, studio range for Y'CbCr (JPEG formats say otherwise), and samples of colour on
/// the left of their pixels, at full range in the middle.
class PixelConverter {
 public:
  /// Frames of another size than this are scaled to it: smaller ones by cubic interpolation, those of at least twice
  /// the size by averaging.
  void set_size(int width, int height, Orientation orientation);
  Orientation orientation() const { return orientation_; }
  void to_image(const AVFrame& frame, Image& image);
  void to_planes(const AVFrame& frame, Planes& planes);

 private:
  /// Converts to `format` (an AVPixelFormat) with `bytes_per_pixel` bytes in buffer_, unturned.
  void convert(const AVFrame& frame, int format, int bytes_per_pixel);
  Handle<SwsContext> scaler_;
  /// Source format, width, height, siting of colours, matrix, range, target format, size.
  int made_for_[9] = {-1, 0, 0, 0, 0, 0, 0, 0, 0};
  int width_ = 0, height_ = 0;
  Orientation orientation_;
  std::vector<std::uint8_t> buffer_;
};

/// Of an AVPixelFormat: channels (1, 3, 4), bits a channel, colours at half the resolution both ways.
int num_channels_of(int pixel_format);
int bit_depth_of(int pixel_format);
bool has_coarse_colour(int pixel_format);

}  // namespace motex::libav
