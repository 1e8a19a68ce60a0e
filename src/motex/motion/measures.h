// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/motion/clip.h"

namespace motex {

struct CompareOptions {
  double threshold = 2.0;
  bool keep_glitches = false;
  bool tips = true;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"threshold", "", "a window of the reference is covered below this distance per frame"}, self.threshold,
          Range{0, 1e6});
    visit(Field{"keep_glitches", "", "do not leave out frames of the reference in which the body jumps"},
          self.keep_glitches, Range{});
    visit(Field{"tips", "", "count end sites as joints: toes, finger tips, crown of the head"}, self.tips, Range{});
  }
};

/// Raw values of one side, lengths in the skeleton's unit, at the clips' own frame rate. Joints are those of
/// CompareOptions; "relative" means position minus the travelling joint's position in world axes (no rotation taken
/// out); H = the reference's largest vertical extent of the body.
struct MotionMeasures {
  Index num_frames = 0;
  double jerk = 0;           ///< mean ‖Δ³ relative position‖ · rate³ / H over joints and frames, 1/s³
  double contact_speed = 0;  ///< units/s: mean horizontal speed of the feet over steps between two frames in contact
  double contact_share = 0;  ///< share of such steps; 0 makes contact_speed 0
  double pose_jump = 0;      ///< units/s: largest ‖Δ relative position‖ · rate of any joint
  double speed = 0;          ///< units/s: mean ‖Δ position‖ · rate over joints and frames, in the world
  double height_min = 0, height_max = 0;  ///< units: of the travelling joint
};

/// Generated / reference, where it says ratio; 0/0 counts as 1.
struct CompareReport {
  double coverage = 0;          ///< 0 … 1
  double global_diversity = 0;  ///< per frame
  double local_diversity = 0;
  double jerk_ratio = 0;
  double contact_speed_ratio = 0;
  double pose_jump_ratio = 0;
  double speed_ratio = 0;
  MotionMeasures reference, generated;
  double body_height = 0;         ///< H
  std::vector<std::string> feet;  ///< the four joints that count as feet; "tip of X" for an end site
  Index num_glitch_frames = 0;    ///< of the reference, left out
  Index num_reference_windows = 0;
};

/// Frames first … first + count − 1 of one of several clips.
struct ClipRange {
  int clip_idx = 0;
  Index first = 0, count = 0;
};

/// The measures by which generated motion is compared with its source [docs/results.md].
///
/// Coverage and diversity (match_windows): both sides at 30 frames/s; a frame's features are the first two columns of
/// every joint's rotation matrix in its parent's frame, the root's included, no position; windows of 30 (local: 15)
/// frames, which never cross clips or what was left out.
/// Contact: feet = the four joints whose 5th height percentile is lowest in the reference; in contact below their floor
/// (2nd height percentile, of each side for itself) + 3 % of H.
/// Of the reference, glitch frames (find_glitch_frames) are left out, and the first ten frames of a clip when one of
/// them is a glitch (a rest pose that jumps); of the generated clip nothing.
///
/// Clips must have one skeleton (joint names and parents). Cost: 3,000 generated seconds against 900 of reference take
/// some seconds. Throws InvalidInput when a side is shorter than one second in one piece, Cancelled.
CompareReport compare_motion(std::span<const Clip> reference, const Clip& generated, const CompareOptions& options = {},
                             const JobContext& job = {});
/// Against parts of clips, such as the source frames of the segments that a walk used: a part that is used twice counts
/// twice.
CompareReport compare_motion(std::span<const Clip> reference, std::span<const ClipRange> ranges, const Clip& generated,
                             const CompareOptions& options = {}, const JobContext& job = {});

}  // namespace motex
