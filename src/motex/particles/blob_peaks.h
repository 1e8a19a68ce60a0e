// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/image/planes.h"

namespace motex {

/// A local maximum over place and scale.
struct BlobPeak {
  double x = 0, y = 0;   ///< pixels, between pixels by a parabola
  double scale = 1;      ///< of the Gaussian spot that peaks so, pixels
  double response = 0;   ///< deviations of the response to white noise of deviation 1
  double amplitude = 0;  ///< of that spot
};

/// Local maxima above `threshold` of |G_a − G_2a| * image (or of its positive part alone), a = 0.8 · 2^{j/2} px up to
/// the scale asked for, each divided by the norm of its kernel. Octaves are computed on every second pixel of the one
/// before. Edge pixels are repeated outwards. Strongest first.
std::vector<BlobPeak> find_blob_peaks(const Plane& image, double max_scale, double threshold, bool both_signs);

}  // namespace motex
