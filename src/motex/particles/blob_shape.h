// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "motex/particles/blob_fit.h"

namespace motex {

/// P of Blob.
struct BlobPrecision {
  double xx, xy, yy;
};

BlobPrecision precision_of(double log_scale, double e1, double e2);

/// Pixels left … right − 1, top … bottom − 1.
struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;
  int width() const { return right - left; }
  int height() const { return bottom - top; }
  bool is_empty() const { return right <= left || bottom <= top; }
  /// 0 of an empty one, whose width or height may be negative: of a blob beyond the picture.
  std::size_t area() const {
    return is_empty() ? 0 : static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  }
};

PixelBox intersection(const PixelBox& a, const PixelBox& b);

/// Where the blob is above 1/250 of its peak, and `margin` pixels around, cut to the image.
PixelBox box_of(const Blob& blob, const Plane& image, double margin);

/// e^{−q/2} over the box, row by row.
void fill_gaussian(const Blob& blob, const PixelBox& box, float* out);

}  // namespace motex
