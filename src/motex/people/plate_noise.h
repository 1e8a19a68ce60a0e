// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "motex/core/job.h"
#include "motex/image/image.h"
#include "motex/image/planes.h"

namespace motex {

constexpr double kLeastPlateNoise =
    1.2;  ///< grey levels: rounding to 8 bits, and what a codec adds near whatever moves
constexpr double kLargestPlateNoise = 12;  ///< what varies more is not noise

enum class PlateTexture {
  kSmooth,   ///< a screen: noise is alike over tens of pixels
  kDetailed  ///< edges that a trembling camera and compression make restless
};

/// CleanPlate::noise: from the median over frames and 16 × 16 pixels of the squared difference between the means of
/// 2 × 2 pixels and the picture's; what differs by more than 8 deviations of `typical` is taken for the actor.
Plane measure_plate_noise(const Image& picture, std::span<const Image> frames, double typical, PlateTexture texture,
                          const JobContext& job);

}  // namespace motex
