// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "motex/particles/birth_death.h"

namespace motex {

/// Takes births and deaths off the maps that tracking made and no element had. Only where births (deaths) are so rare
/// that one here and now is improbable, so that sources and sinks are not touched:
/// gaps     a death whose cable, carried on, meets a birth within five frames
/// flashes  cables shorter than three frames
/// crowds   ends beside another element: two that covered one another were seen as one
/// Of gaps and crowds as many, nearest first, as are more than chance makes.
void drop_false_ends(std::span<const Cable> cables, std::int64_t num_frames, BirthDeathMaps& maps);

}  // namespace motex
