// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/core/matrix.h"
#include "motex/people/motif.h"

namespace motex {

/// A series that moves as the given one does in `parts` but repeats nothing: each signal is a Gaussian autoregressive
/// process (Burg's method over all parts, the order by Schwarz' criterion, poles drawn in so that nothing is remembered
/// for longer than about `memory` frames), the signals' innovations correlated as they are in the series. differenced:
/// the process describes the signals' differences, so that it wanders as a random walk does.
FrameMatrix background_series(const FrameMatrix& series, const std::vector<FrameSpan>& parts, double memory,
                              bool differenced, int num_frames);

}  // namespace motex
