// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "motex/image/image.h"

namespace motex {

/// How many pixels to the right of where a file of coarse colours says its colours lie, −½, 0 or ½: programs that make
/// 4:2:0 video of RGB often say one place and put them in another, half a pixel off.
///
/// Across an outline of the actor a pixel is I = α (k F) + (1 − α) B and lies in the plane of the actor's colour F and
/// the plate's B whatever α and shading k are; colours from another place than the light take it out of there. The sums
/// R of its squared distances from the plane for colours read half a pixel further left and right are the same where
/// colours lie right. Where (R₋ − R₊) / (R₋ + R₊) is beyond ± 0.12 they lie on that side. 0 where fewer than 300
/// outlines tell anything: grey ones do not.
float measure_chroma_shift(const Image& picture, std::span<const Image> frames);

}  // namespace motex
