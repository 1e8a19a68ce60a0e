// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/motion_texture/model.h"

namespace motex {

/// Of each instance, in cm a frame: how fast joints and end sites move in the world, on average over them and over ten
/// frames a second of its own; 0 for an instance of one frame.
std::vector<double> mean_speeds(const MotionTexture& model);

/// Of each instance: u = its mean speed / mean − 1, the mean taken over all frames of the instances `among`, each
/// texton weighted by how much oftener edits make it visited. All 0 where nothing moves.
std::vector<double> liveliness(const MotionTexture& model, const std::vector<int>& among);
/// Among all instances.
std::vector<double> liveliness(const MotionTexture& model);

}  // namespace motex
