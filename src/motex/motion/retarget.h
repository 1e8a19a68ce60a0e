// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motex/core/job.h"
#include "motex/core/options.h"
#include "motex/motion/clip.h"
#include "motex/motion/joint_map.h"

namespace motex {

/// A body in a known posture.
struct PosedSkeleton {
  Skeleton skeleton;
  Pose pose;  ///< of the world
};
/// No joint turned, every joint at its offset.
PosedSkeleton at_rest(const Skeleton& skeleton);
/// As its skin was bound, so that joints' frames may lie as they like; at rest where there is no skin.
PosedSkeleton as_bound(const Skeleton& skeleton);
PosedSkeleton at_frame(const Clip& clip, Index frame);

struct RetargetOptions {
  double scale = 0;
  bool foot_fix = true;

  template <typename Self, typename Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit(Field{"scale", "", "length of the new body for one of the old; auto: the ratio of their legs"}, self.scale,
          Range{1e-6, 1e6, true});
    visit(Field{"foot_fix", "", "hold planted feet"}, self.foot_fix, Range{});
  }
};

struct RetargetReport {
  double scale = 1;
  int num_limbs = 0;                   ///< bones between two joints with a source, one such bone at their upper joint
  double mean_direction_error = 0;     ///< degrees between such a bone in the source and in the result, before the feet
  double max_direction_error = 0;      ///< are held
  double height_shift = 0;             ///< units of the target: the body was lifted so much, so that the feet touch
  double source_contact_speed = 0;     ///< target's units/s: horizontal speed of the source's planted feet, scaled
  double contact_speed_before = 0;     ///< of the result's, before the feet are held
  double contact_speed_after = 0;      ///< and after
  std::vector<std::string> unmatched;  ///< joints of the target without source: they keep their angles at rest
  std::vector<std::string> unused;     ///< joints of the source that nothing takes from
};

/// The motion on another body: world directions of the bones are kept.
///
/// Both bodies are given in one posture (T-pose, say); where bones point elsewhere in the two, the target's are first
/// turned to the source's: D_j, from the root on, is the smallest turn after its parent's that brings the bones from j
/// to the next joints with a source to the directions they have in the source. Then, with W the world rotations and W⁰
/// those in the posture,
///
///   W_target(t) = W_source(t) · W_source⁰⁻¹ · D · W_target⁰
///
/// Feet keep their soles: they are only turned about the vertical where both bodies stand. The travelling joint is
/// where the source's is, times the scale, and lifted so that the lowest point of the feet (2nd percentile) is as high
/// as in the source, times the scale. Joints without source keep their angles and all joints their distances. Without
/// feet the height is scaled as the rest. Throws InvalidInput when the map does not fit the skeletons or joins nothing.
Clip retarget(const Clip& source, const Pose& source_pose, const PosedSkeleton& target, const JointMap& map,
              const RetargetOptions& options, RetargetReport& report, const JobContext& job = {});

}  // namespace motex
