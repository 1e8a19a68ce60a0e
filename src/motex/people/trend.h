// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/core/matrix.h"
#include "motex/people/template_match.h"

namespace motex {

/// Less the best straight line of each signal: what only rises repeats nothing. Numbers that are not finite stay so.
FrameMatrix without_line(const FrameMatrix& given);

/// A straight line explains 80 % of the pattern, or a parabola 96 %: everything that only drifts resembles it.
bool is_drift(const Pattern& pattern);

}  // namespace motex
