// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/detect_cores.h"
#include "motex/particles/element_shapes.h"

namespace motex {

/// detect_blobs() for elements with parts: the frame is explained by elements of the clip's shapes, those that paths
/// lead one to expect first, then where what they leave has peaks that a shape fits. Returns their cores, strongest
/// first.
/// residual: luma minus background; options: decided(); expected: cores; left: what the elements leave.
std::vector<Blob> detect_shaped_blobs(const Plane& residual, const ElementShapes& shapes, const DetectOptions& options,
                                      double noise, const std::vector<ExpectedBlob>& expected, Plane* left = nullptr);

}  // namespace motex
