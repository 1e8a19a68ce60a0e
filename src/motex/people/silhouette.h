// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace motex {

/// Rectangle of pixels, all ends inside; empty when right < left.
struct BoundingBox {
  int left = 0, top = 0, right = -1, bottom = -1;
  bool empty() const { return right < left; }
  int width() const { return right - left + 1; }
  int height() const { return bottom - top + 1; }
};

/// What the silhouette of one frame (pixels with alpha ≥ ½) measures. [PT04] section 2.1
struct Silhouette {
  BoundingBox box;
  double area = 0;                        ///< sum of alpha / 255 over all pixels, square pixels
  double centroid_x = 0, centroid_y = 0;  ///< of alpha, pixels of the frame
  /// Central moments μ_pq / area^(1 + (p + q)/2) of alpha: shape without place and scale. μ30 changes sign in the
  /// mirror.
  double mu20 = 0, mu11 = 0, mu02 = 0, mu30 = 0, mu21 = 0, mu12 = 0, mu03 = 0;

  bool empty() const { return box.empty(); }
  double aspect() const {
    return box.empty() ? 0 : static_cast<double>(box.width()) / box.height();
  }  ///< width / height
};

}  // namespace motex
