// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/people/motif_seeds.h"

namespace motex {

/// An action that is held for a while in the middle (a bow) is found as two, how it begins and how it ends. Two motifs
/// of which at least three performances of one are followed by the other within 1.2 s, and two thirds of all of either
/// are, become one when these agree as matches do (0.85) and are said more shortly as one than as two (MotifCode).
/// Joins the first such pair; false: there is none.
bool join_parts(const MotifSearch& search, std::vector<Motif>& motifs);

}  // namespace motex
