// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/element_light.h"
#include "motex/particles/textured_motion.h"

namespace motex {

/// Cables whose bases, drawn alone, show bright spots although the elements are darker than what is behind them (or
/// dark ones although they are brighter): [cable] 1 where that is so in a quarter of its frames. Where elements crowd,
/// coils take back light of neighbours; without these they are specks. None where the clip has dark and bright
/// elements, and none of cables without coils.
std::vector<char> find_stray_light(const TexturedMotion& model);

/// The light that the model's elements may add in a picture. Where three quarters of it in the clip's frames is of one
/// sign, light of the other sign goes as far as nineteen twentieths of such light do there; else nothing is limited.
ElementLight element_light(const TexturedMotion& model);

}  // namespace motex
