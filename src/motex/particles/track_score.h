// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "motex/particles/track.h"

namespace motex {

/// How near estimated tracks Y come to true tracks X, with gate ε ([Chenouard 2014], its measures in its notation).
///
/// d(x, y) = Σ_t min(‖x(t) − y(t)‖, ε) over the frames of either, ε where only one exists. Each true track is paired
/// with one estimated track or with nothing (ε · its length) so that the sum D is smallest; D∅ = ε · all true points.
struct TrackingScore {
  double alpha = 0;       ///< 1 − D / D∅
  double beta = 0;        ///< (D∅ − D) / (D∅ + ε · points of unpaired estimated tracks): the primary one
  double jsc = 0;         ///< points: TP / (TP + FN + FP); true positive = paired and nearer than ε
  double jsc_tracks = 0;  ///< tracks: pairs / (pairs + unpaired true + unpaired estimated)
  double rmse = 0;        ///< pixels, over true positives; NaN without any
  int num_true = 0, num_estimated = 0, num_pairs = 0;
};

/// Pairing is exact. Cost: a shortest path per true track within groups of tracks that come near one another.
/// Throws InvalidInput when there is no true track, frames of a track do not rise, or gate ≤ 0.
TrackingScore score_tracks(const std::vector<Track>& truth, const std::vector<Track>& estimate, double gate = 5);

/// Without the points outside a picture of width × height pixels (−0.5 … width − 0.5) or of amplitude 0, and without
/// tracks that have none left. width = 0: no picture.
std::vector<Track> visible_part(const std::vector<Track>& tracks, int width, int height);

}  // namespace motex
