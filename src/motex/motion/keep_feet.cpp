// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/keep_feet.h"

#include "motex/core/error.h"
#include "motex/motion/foot_fix_solver.h"

namespace motex {
namespace {

void keep_foot(const Pose& before, const Pose& pose, const Leg& leg, Clip& clip, Index frame) {
  const Vector3 shift = before.positions.col(leg.ankle_idx) - pose.positions.col(leg.ankle_idx);
  const Quat foot = before.rotation(leg.ankle_idx);
  if (shift.norm() < 1e-9 && angle_between(foot, pose.rotation(leg.ankle_idx)) < 1e-9) return;
  const LegSolution solved = solve_leg(pose, leg, Vector3::Zero(), shift);
  const int over = clip.skeleton.joints[static_cast<std::size_t>(leg.hip_idx)].parent_idx;
  const Quat above = over < 0 ? Quat::Identity() : pose.rotation(over);
  clip.set_rotation(frame, leg.hip_idx, (above.conjugate() * solved.thigh).normalized());
  clip.set_rotation(frame, leg.knee_idx, (solved.thigh.conjugate() * solved.shank).normalized());
  clip.set_rotation(frame, leg.ankle_idx, (solved.shank.conjugate() * foot).normalized());
}

}  // namespace

void keep_feet(const Clip& base, const FootModel& model, Clip& clip) {
  const std::string difference = skeleton_difference(base.skeleton, clip.skeleton);
  if (!difference.empty() || base.num_frames() != clip.num_frames())
    throw InvalidInput("keep_feet: the clips differ: " + (difference.empty() ? "other lengths" : difference));
  Pose before, pose;
  for (Index t = 0; t < clip.num_frames(); ++t) {
    forward_kinematics(base, t, before);
    forward_kinematics(clip, t, pose);
    for (const Leg& leg : model.legs) keep_foot(before, pose, leg, clip, t);
  }
}

}  // namespace motex
