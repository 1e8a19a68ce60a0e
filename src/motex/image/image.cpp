// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/image/image.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr int kMaxSide = 32768;

std::size_t checked_area(int width, int height) {
  if (width < 0 || height < 0 || width > kMaxSide || height > kMaxSide)
    throw InvalidInput("an image of " + std::to_string(width) + " × " + std::to_string(height) +
                       " pixels cannot be made: sides go up to " + std::to_string(kMaxSide));
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

std::uint8_t to_byte(double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0) + 0.5); }

}  // namespace

Rgba with_alpha(Rgba colour, double alpha) {
  colour.a = to_byte(colour.a * alpha);
  return colour;
}

Rgba mix(Rgba a, Rgba b, double weight) {
  const auto between = [weight](std::uint8_t x, std::uint8_t y) { return to_byte(x + weight * (y - x)); };
  return {between(a.r, b.r), between(a.g, b.g), between(a.b, b.b), between(a.a, b.a)};
}

Image::Image(int width_px, int height_px, Rgba fill)
    : width(width_px), height(height_px), pixels(checked_area(width_px, height_px), fill) {}

void blend(Rgba& pixel, Rgba colour, double coverage) {
  const double source = coverage * colour.a / 255.0;
  if (source <= 0) return;
  if (source >= 1) {
    pixel = {colour.r, colour.g, colour.b, 255};
    return;
  }
  const double below = (1 - source) * pixel.a / 255.0;
  const double alpha = source + below;
  const auto over = [&](std::uint8_t top, std::uint8_t bottom) {
    return to_byte((source * top + below * bottom) / alpha);
  };
  pixel = {over(colour.r, pixel.r), over(colour.g, pixel.g), over(colour.b, pixel.b), to_byte(255 * alpha)};
}

Image crop(const Image& image, int left, int top, int width, int height) {
  if (left < 0 || top < 0 || width < 0 || height < 0 || width > image.width - left || height > image.height - top)
    throw InvalidInput("the rectangle to crop is not inside the image");
  Image out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) out.at(x, y) = image.at(left + x, top + y);
  return out;
}

void paste(Image& target, const Image& source, int left, int top) {
  const int last_x = std::min(source.width, target.width - left), last_y = std::min(source.height, target.height - top);
  for (int y = std::max(0, -top); y < last_y; ++y)
    for (int x = std::max(0, -left); x < last_x; ++x) blend(target.at(left + x, top + y), source.at(x, y), 1);
}

}  // namespace motex
