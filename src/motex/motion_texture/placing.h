// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/motion_texture/features.h"

namespace motex {

/// The clip turned about the vertical and moved over the floor so that its first frame stands at `place`. Throws
/// InvalidInput for a clip without frames.
Clip stand_at(const FeatureSpace& space, const Clip& clip, const RootPlace& place);

}  // namespace motex
