// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "motex/image/image.h"

namespace motex {

/// One number a pixel, row by row from the top left; grey levels 0 … 255 where it stands for light.
struct Plane {
  int width = 0;
  int height = 0;
  std::vector<float> values;  ///< width · height

  Plane() = default;
  /// Throws InvalidInput unless sizes are 0 … 32768.
  Plane(int width_px, int height_px, float fill = 0);

  float& at(int x, int y) { return values[index(x, y)]; }
  const float& at(int x, int y) const { return values[index(x, y)]; }
  float* row(int y) { return values.data() + index(0, y); }
  const float* row(int y) const { return values.data() + index(0, y); }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// Planes of one size: 1 = grey, 3 = R, G, B, 4 = R, G, B, alpha.
using Planes = std::vector<Plane>;

/// Whether every pixel has r = g = b.
bool is_grey(const Image& image);
/// Whether every pixel has alpha 255.
bool is_opaque(const Image& image);

/// Grey when all pixels are, alpha only when some pixel is not opaque.
Planes to_planes(const Image& image);
/// Exactly that many planes (1, 3 or 4); 1 is the luma of a coloured image. Throws InvalidInput for another number.
Planes to_planes(const Image& image, int num_planes);
/// Rounds to 8 bits and cuts off at 0 and 255. Throws InvalidInput unless there are 1, 3 or 4 planes of one size.
Image to_image(const Planes& planes);
Image to_image(const Plane& grey);

/// Y' = 0.299 R + 0.587 G + 0.114 B (BT.601).
template <typename Number>
constexpr Number luma_of(Number r, Number g, Number b) {
  return Number(0.299) * r + Number(0.587) * g + Number(0.114) * b;
}
/// That of each pixel, in grey levels.
Plane luma(const Image& image);
Plane luma(const Planes& planes);

/// a − b. Throws InvalidInput unless the sizes are equal.
Plane minus(Plane a, const Plane& b);
Plane negated(Plane plane);
/// Plane by plane. Throws InvalidInput unless there are as many.
Planes minus(Planes a, const Planes& b);
/// Σ v² over the pixels.
double sum_of_squares(const Plane& plane);
/// Whether a point lies on a pixel of a picture of that size: −½ ≤ x < width − ½.
inline bool is_inside(double x, double y, int width, int height) {
  return x >= -0.5 && y >= -0.5 && x < width - 0.5 && y < height - 0.5;
}

/// 10 log₁₀(255² / mean squared difference) in dB, infinite for equal planes.
/// Throws InvalidInput when the sizes differ or are zero.
double psnr(const Plane& a, const Plane& b);
/// Over all planes together.
double psnr(const Planes& a, const Planes& b);
/// Over R, G, B.
double psnr(const Image& a, const Image& b);

}  // namespace motex
