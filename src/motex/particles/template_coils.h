// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/moveton_patch.h"
#include "motex/particles/moveton_template.h"

namespace motex {

/// Mean and deviation of numbers.
Spread spread_of(const std::vector<double>& values);

/// The coils that movetons of one shape have in common. movetons: the coil bases of each. Coil bases of all movetons
/// are matched: around the base that has most others like it (kind, place, scale, angle, sign and size of the
/// coefficient), at most one of each moveton; they become one TemplateCoil whose presence is their share; then the next
/// one, down to min_presence. Strongest first.
std::vector<TemplateCoil> common_coils(const std::vector<std::vector<RelativeBase>>& movetons, int num_planes,
                                       double min_presence, int max_coils);

}  // namespace motex
