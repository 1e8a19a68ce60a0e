// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace motex {

/// sRGB colour, alpha not premultiplied; alpha 255 is opaque.
struct Rgba {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;
  friend bool operator==(const Rgba&, const Rgba&) = default;
};

/// The same colour at opacity × alpha, alpha in 0 … 1.
Rgba with_alpha(Rgba colour, double alpha);
/// (1 − weight) · a + weight · b in every component, weight in 0 … 1.
Rgba mix(Rgba a, Rgba b, double weight);

/// Pixels row by row from the top left; pixel centres are at integers.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Rgba> pixels;  ///< width · height

  Image() = default;
  /// Throws InvalidInput unless sizes are 0 … 32768.
  Image(int width_px, int height_px, Rgba fill = {0, 0, 0, 0});

  Rgba& at(int x, int y) { return pixels[index(x, y)]; }
  const Rgba& at(int x, int y) const { return pixels[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// Source-over: pixel ← colour over pixel, with the colour's alpha times coverage (0 … 1).
void blend(Rgba& pixel, Rgba colour, double coverage);

/// The rectangle as its own image. Throws InvalidInput unless it lies inside.
Image crop(const Image& image, int left, int top, int width, int height);
/// Blends source over target with its top left pixel at (left, top); what falls outside is cut off.
void paste(Image& target, const Image& source, int left, int top);

}  // namespace motex
