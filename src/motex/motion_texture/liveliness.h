// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/motion_texture/model.h"

namespace motex {

/// z of each instance: its mean movement (of the body in its heading frame, and of the root over the floor; cm a
/// frame), in deviations from the mean over all frames of all instances.
std::vector<double> liveliness(const MotionTexture& model);

}  // namespace motex
