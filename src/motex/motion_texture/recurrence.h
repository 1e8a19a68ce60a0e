// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "motex/core/job.h"
#include "motex/motion_texture/model.h"

namespace motex {

/// Whether the moves that textons stand for come again in clips that were not learned from.
///
/// The distance of a segment s to a texton is the mean over the texton's training segments r of
///
///   d(s, r) = 1/T_min · Σ_{t < T_min} |y_s(t) − y_r(t)|,   y = weighted features, cm,
///
/// frame by frame from their starts, nothing warped. Segments shorter than T_min (ends of clips) are not counted.
struct RecurrenceReport {
  int num_segments = 0;            ///< recognised, by their moves
  double distance_to_label = 0;    ///< cm: to the texton that it was recognised as, mean over segments
  double distance_to_random = 0;   ///< cm: to all training segments
  double distance_to_nearest = 0;  ///< cm: to the nearest texton
  int num_transitions = 0;         ///< between recognised segments
  double transitions_seen = 0;     ///< share of them that occur in the training clips
  double transitions_chance = 0;   ///< the same share when first and second textons are paired at random
  /// Nats per frame along the labels, paths of moves left out, and of one global system.
  double log_likelihood_per_frame = 0, global_lds_log_likelihood_per_frame = 0;

  double distance_ratio() const { return distance_to_label / distance_to_random; }
};

/// Throws InvalidInput like score_clips(), and when no segment is as long as T_min.
RecurrenceReport measure_recurrence(const MotionTexture& model, std::span<const Clip> clips,
                                    const JobContext& job = {});

}  // namespace motex
