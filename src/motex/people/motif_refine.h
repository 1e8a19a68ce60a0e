// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/matrix.h"
#include "motex/people/motif.h"
#include "motex/people/motif_seeds.h"

namespace motex {

/// Makes whole actions of what was found first, the tightest patterns. Where the window was not asked for:
/// - a window is halved when its halves differ no more, on the mean, than two performances of the same half do (and lie
///   no more than √2 R apart): it held two performances;
/// - it grows by pieces of 0.2 s to half its length as long as a piece moves (a twentieth of the window's variance) and
///   more than half of what it moves is the same in every performance (correlation with the mean of the others above
///   1/√2), and the whole still agrees as matches do (0.85). It never grows over its own next performance;
/// - of motifs that now share frames, the one with most frames keeps them.
/// Last, performances left over are gathered (gather_performances()), parts of one action are joined (join_parts()),
/// and what the end of a take cuts off is shortened to what is seen of it.
void refine_motifs(MotifSearch& search, const std::vector<FrameSpan>& active, std::vector<Motif>& motifs);

}  // namespace motex
