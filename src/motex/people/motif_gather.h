// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/people/motif_seeds.h"

namespace motex {

/// What is left over and resembles the mean of a motif so well that chance brings it less than 0.05 times in the series
/// (inside options.radius where that is given) is one of its performances: the closest first. So is what the end of a
/// take cuts off, when two thirds of it are seen: these are compared, and what chance makes of so much of the pattern.
/// Such an occurrence lies partly outside its take. active: what the background is fitted to.
void gather_performances(const MotifSearch& search, const std::vector<FrameSpan>& active, std::vector<Motif>& motifs);

}  // namespace motex
