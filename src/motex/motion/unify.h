// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/job.h"
#include "motex/motion/clip.h"

namespace motex {

/// Gives all clips one skeleton and one frame rate, so that they can be learned from together.
///
/// Skeletons agree when joint names and parents do. Offsets may differ by 5 % of their length (short bones: of 1 % of
/// all bones together) and are averaged over the clips; the translations of such joints, which stand still, follow.
/// Roots, and joints that travel in some clip, take their place from the frames: their offsets, all channels and the
/// end sites become those of the first clip. Of different frame rates the lowest is kept. Lengths are brought to the
/// first clip's unit where units are known (see match_unit); a known unit holds for all. Changes are said by job.warn.
/// Throws InvalidInput naming two clips and the first joint that differs.
void unify_clips(std::vector<Clip>& clips, const JobContext& job = {});

}  // namespace motex
