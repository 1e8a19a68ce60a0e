// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "motex/motion/contacts.h"

namespace motex {

/// Where the floor is for each point that can go through it: ankles and toes have their own level (FootModel: their 2nd
/// height percentile in the examples); every other joint and tip the lowest of these.
///
/// How deep the body of a frame lies below it, in units, by point: a column per leg for its foot, one for the rest of
/// the body; 0 above the floor. `pose` is that of the frame.
void depths_below_floor(const Skeleton& skeleton, const FootModel& model, const Pose& pose, Eigen::Ref<Vector> depths);

struct FloorReport {
  Index num_frames = 0;
  Index num_below_before = 0, num_below_after = 0;  ///< frames with a point more than 1 mm below the floor
  double deepest_before = 0, deepest_after = 0;     ///< units
  double largest_lift = 0;                          ///< units
};

/// Keeps a stream of frames above the floor, late by 0.2 s, in constant memory. A foot is raised by bending its leg,
/// and keeps its rotation; for the rest of the body, or where the leg cannot bend enough softly, all of it is raised.
/// Each lift is the least smooth curve above what is needed: its largest value within 0.1 s, averaged over ± 0.1 s.
class FloorFixer {
 public:
  /// Throws InvalidInput when the model's joints are not the skeleton's.
  FloorFixer(const FootModel& model, const Skeleton& skeleton, double frame_time_secs);
  ~FloorFixer();
  FloorFixer(FloorFixer&&) noexcept;

  /// Takes row `frame` of the clip. A pinned frame comes out as it went in; lifts fade around it.
  void push(const Clip& clip, Index frame, bool pinned = false);
  void finish();
  /// Writes the next frame into row `frame` of `out`. False when it is not decided yet, or all are out.
  bool pop(Clip& out, Index frame);
  /// Of the frames popped so far.
  FloorReport report() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// FloorFixer over a whole clip, in place. pinned: frames that must not change.
FloorReport keep_above_floor(Clip& clip, const FootModel& model, std::span<const Index> pinned = {});

}  // namespace motex
