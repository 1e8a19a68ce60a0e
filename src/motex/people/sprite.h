// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "motex/image/image.h"

namespace motex {

/// R, G, B times alpha, and alpha, 0 … 255: R, G, B ≤ alpha.
using PremultipliedRgba = std::array<std::uint8_t, 4>;

/// The actor cut out of one frame: a rectangle of premultiplied pixels at its place in the frame. Outside it everything
/// is transparent; width = height = 0 when nobody is there. Pixel centres are at integers.
struct Sprite {
  int left = 0, top = 0;  ///< of the rectangle, in pixels of the frame; may lie outside it
  int width = 0, height = 0;
  std::vector<PremultipliedRgba> pixels;  ///< width · height, row by row

  bool empty() const { return width == 0; }
  PremultipliedRgba& at(int x, int y) { return pixels[index(x, y)]; }
  const PremultipliedRgba& at(int x, int y) const { return pixels[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// What of the image is not transparent.
Sprite sprite_of(const Image& image);
/// The sprite in a transparent frame of that size, alpha not premultiplied; what lies outside is cut off.
Image to_image(const Sprite& sprite, int width, int height);
/// Source-over with premultiplied colours: pixel ← sprite + (1 − alpha) · pixel; what lies outside is cut off.
void paint(Image& image, const Sprite& sprite);
/// As in a mirror standing at the middle of a frame of that width.
Sprite mirrored(const Sprite& sprite, int frame_width);

/// Gives the frames of a people texture by number; frames asked for in rising order are cheapest. Not thread-safe: each
/// thread has its own.
class SpriteSource {
 public:
  virtual ~SpriteSource() = default;
  virtual int num_frames() const = 0;
  /// The frame, shared: it stays whole while someone holds it. Throws InvalidInput outside 0 … num_frames() − 1.
  virtual std::shared_ptr<const Sprite> sprite(int frame) = 0;
};

/// Frames held in memory.
class MemorySprites : public SpriteSource {
 public:
  explicit MemorySprites(std::vector<Sprite> sprites);
  int num_frames() const override { return static_cast<int>(sprites_.size()); }
  std::shared_ptr<const Sprite> sprite(int frame) override;

 private:
  std::vector<std::shared_ptr<const Sprite>> sprites_;
};

}  // namespace motex
