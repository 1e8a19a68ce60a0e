// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/core/job.h"
#include "motex/motion/clip.h"

namespace motex {

enum class LengthUnit { kAuto, kM, kCm, kMm, kInch, kFt };
/// Metres of one unit; 0 for kAuto.
double metres_per_unit(LengthUnit unit);

/// Multiplies every length of the clip; metres_per_unit, where known, is divided.
void scale_lengths(Clip& clip, double factor);

/// How many units of `to` one unit of `from` is; 1 when nothing says that they differ.
///
/// Both units known: their ratio. Otherwise the ratio of the bones, if all bones have it within 5 % (short ones: of 1 %
/// of all together) and it is no body's growth: beyond 1.5 or below 1 / 1.5. Skeletons have equal joints and parents.
double units_per_unit(const Skeleton& from, const Skeleton& to);

/// Brings a clip to the unit of a skeleton with equal joints and parents, and says so.
void match_unit(Clip& clip, const Skeleton& to, const JobContext& job = {});

}  // namespace motex
