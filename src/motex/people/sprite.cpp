// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/people/sprite.h"

#include <algorithm>
#include <string>
#include <utility>

#include "motex/core/error.h"
#include "motex/people/premultiply.h"

namespace motex {
namespace {

std::uint8_t quotient(int value, int alpha) {
  return static_cast<std::uint8_t>(std::min(255, (value * 255 + alpha / 2) / alpha));
}

std::uint8_t over(int front, int alpha, int back) {
  return static_cast<std::uint8_t>(std::min(255, front + premultiplied(back, 255 - alpha)));
}

}  // namespace

Sprite sprite_of(const Image& image) {
  int left = image.width, top = image.height, right = -1, bottom = -1;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y).a == 0) continue;
      left = std::min(left, x), right = std::max(right, x);
      top = std::min(top, y), bottom = y;
    }
  }
  Sprite sprite;
  if (right < left) return sprite;
  sprite.left = left, sprite.top = top;
  sprite.width = right - left + 1, sprite.height = bottom - top + 1;
  sprite.pixels.reserve(static_cast<std::size_t>(sprite.width) * static_cast<std::size_t>(sprite.height));
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const Rgba& p = image.at(x, y);
      sprite.pixels.push_back({premultiplied(p.r, p.a), premultiplied(p.g, p.a), premultiplied(p.b, p.a), p.a});
    }
  }
  return sprite;
}

Image to_image(const Sprite& sprite, int width, int height) {
  Image image(width, height);
  for (int y = std::max(0, -sprite.top); y < std::min(sprite.height, height - sprite.top); ++y) {
    for (int x = std::max(0, -sprite.left); x < std::min(sprite.width, width - sprite.left); ++x) {
      const auto& [r, g, b, a] = sprite.at(x, y);
      if (a != 0) image.at(sprite.left + x, sprite.top + y) = {quotient(r, a), quotient(g, a), quotient(b, a), a};
    }
  }
  return image;
}

void paint(Image& image, const Sprite& sprite) {
  for (int y = std::max(0, -sprite.top); y < std::min(sprite.height, image.height - sprite.top); ++y) {
    for (int x = std::max(0, -sprite.left); x < std::min(sprite.width, image.width - sprite.left); ++x) {
      const PremultipliedRgba& front = sprite.at(x, y);
      Rgba& p = image.at(sprite.left + x, sprite.top + y);
      // The picture may be transparent itself: its colours count as far as they are there.
      const std::uint8_t alpha = over(front[3], front[3], p.a);
      if (alpha == 0) continue;
      const auto mixed = [&](int colour, int back) {
        return quotient(over(colour, front[3], premultiplied(back, p.a)), alpha);
      };
      p = {mixed(front[0], p.r), mixed(front[1], p.g), mixed(front[2], p.b), alpha};
    }
  }
}

Sprite mirrored(const Sprite& sprite, int frame_width) {
  Sprite result = sprite;
  result.left = frame_width - sprite.left - sprite.width;
  for (int y = 0; y < sprite.height; ++y) {
    const auto row = result.pixels.begin() + static_cast<std::ptrdiff_t>(y) * sprite.width;
    std::reverse(row, row + sprite.width);
  }
  return result;
}

MemorySprites::MemorySprites(std::vector<Sprite> sprites) {
  sprites_.reserve(sprites.size());
  for (Sprite& sprite : sprites) sprites_.push_back(std::make_shared<const Sprite>(std::move(sprite)));
}

std::shared_ptr<const Sprite> MemorySprites::sprite(int frame) {
  if (frame < 0 || frame >= num_frames()) {
    throw InvalidInput("frame " + std::to_string(frame) + " does not exist: there are " + std::to_string(num_frames()));
  }
  return sprites_[static_cast<std::size_t>(frame)];
}

}  // namespace motex
