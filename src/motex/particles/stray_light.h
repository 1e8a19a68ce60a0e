// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/textured_motion.h"

namespace motex {

/// Cables whose bases, drawn alone, show bright spots although the elements are darker than what is behind them (or
/// dark ones although they are brighter): [cable] 1 where that is so in a quarter of its frames. Where elements crowd,
/// coils take back light of neighbours; without these they are specks. None where the clip has dark and bright
/// elements, and none of cables without coils.
std::vector<char> find_stray_light(const TexturedMotion& model);

}  // namespace motex
