// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "motex/people/silhouette.h"
#include "motex/people/warp_sprites.h"

namespace motex {

/// What of a sprite stands on the ground: its lowest pixels with alpha ≥ ½ (6 % of its height).
struct Footing {
  double x = 0, y = 0;  ///< middle of what stands there and its lowest row, pixels of the frame
  double height = 0;    ///< of the sprite, pixels
};
std::optional<Footing> footing_of(const Sprite& sprite);

/// Whether some foot of `now` stands where it stood in `before`, the frame before it: a piece of what is lowest that is
/// the same up to 15 % of its pixels and whose middle moved by less than 0.15 % of the height.
bool stands_still(const Sprite& before, const Sprite& now);

/// The way back, frame by frame, from where a cut has put an actor to where the footage has them. While a foot stands
/// the offset moves by at most 0.03 % of the height a frame (a tenth of a pixel: not seen); while nothing stands still
/// by up to 0.4 %, getting faster and slower gradually; an actor whom the offset holds outside the frame returns
/// sooner.
class CarriedPlacement {
 public:
  /// The footage of width × height pixels.
  CarriedPlacement(int width, int height) : width_(width), height_(height) {}

  /// A cut has put this sprite there.
  void set(const Sprite& sprite, const Placement& placement);
  /// Where the way ends: the frames' own places, or, at the end of a loop, those of the cut that closes it, to be
  /// reached in that many frames.
  void aim(double x, double y, double scale, int num_frames);

  /// Where the next frame is put. before: the one shown before it; without it the offset stays.
  Placement next(const Sprite* before, const Sprite& now);
  /// Where the frame is put with the offset as it is.
  Placement placement_of(const Sprite& sprite) const;

  double offset_x() const { return x_; }  ///< of the feet, pixels
  double offset_y() const { return y_; }
  double scale() const { return scale_; }

 private:
  double outside(const Sprite& sprite) const;

  int width_, height_;
  double x_ = 0, y_ = 0, scale_ = 1;  // offset of the feet
  double aim_x_ = 0, aim_y_ = 0, aim_scale_ = 1;
  int frames_left_ = 0;  // 0 = no hurry
  double speed_ = 0;     // pixels a frame
};

}  // namespace motex
