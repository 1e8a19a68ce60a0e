// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/motion_texture/model.h"

namespace motex {

/// First row of the two frames at which an instance hands over to the next: the key poses of its successor, or the last
/// two frames of the run.
Index hand_over_row(const MotionTexture& model, const Instance& instance);

/// Distance in cm of two pairs of consecutive frames (root mean square over the two).
double key_pose_distance(const FrameMatrixF& corpus, Index row_a, Index row_b);

/// Median over instances of the distance in cm from where one ends to the nearest key poses that do not follow it in
/// the source; 1 when there are none.
double usual_jump_distance(const MotionTexture& model);

/// Transitions between textons: the observed ones, and for each instance a jump of weight 0.3 to the texton of the
/// instance whose key poses lie nearest to where it hands over, its own successor apart; and a jump into each instance
/// that nothing precedes. Without them many textons lead nowhere.
TransitionMatrix transitions_with_jumps(const MotionTexture& model);

}  // namespace motex
