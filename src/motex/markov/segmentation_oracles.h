// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include "motex/markov/segmentation.h"

/// Slow programs that segment_sequence() is measured against.
namespace motex {

/// The same problem solved by trying every (start, end, state) and every predecessor; exact by construction.
/// O(T · N² + N · T · min(T, T_max)), no prefix sums.
SegmentationReport segment_brute_force(const SegmentationInput& input);

/// The program of [MT02 appendix A] under the same rules: the best segmentation of 0 … t into n segments, of which only
/// the best label of the last one is kept for each (n, t). A better path through another label is lost, so the score is
/// a lower bound. O(N · T² · T / T_min).
SegmentationReport segment_one_label(const SegmentationInput& input);

}  // namespace motex
