// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/limb_target.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "motex/core/error.h"
#include "motex/core/options_check.h"

namespace motex {
namespace {

constexpr double kMissedCm = 1, kMetCm = 0.01;
constexpr int kSweeps = 40, kSteps = 12;
constexpr double kMostTurn = 0.2;     // rad, of a joint in one step
constexpr double kSpineWeight = 0.2;  // against the limb's joints
constexpr double kDamping = 0.02;     // of the limb's length

struct Reach {
  const LimbTarget* target = nullptr;
  int joint = 0;
  std::vector<int> chain;      // joints that turn, from the one above `joint` upwards
  std::size_t limb_size = 0;   // of the chain; the rest is the spine
  std::vector<Vector3> turns;  // δ
  Index first = 0, last = 0;   // frames where w is 0 again
  bool with_spine = false;

  double weight(Index frame) const {
    if (frame <= first || frame >= last) return 0;
    const auto span = static_cast<double>(frame <= target->frame ? target->frame - first : last - target->frame);
    const double u = 1 - static_cast<double>(std::abs(frame - target->frame)) / span;
    return u * u * u * (10 + u * (-15 + 6 * u));
  }
};

int parent_of(const Clip& clip, int joint) { return clip.skeleton.joints[static_cast<std::size_t>(joint)].parent_idx; }

/// Joints between the target and the joint that carries the legs (the last one with a branch above).
void find_chain(const Clip& clip, Reach& reach) {
  std::vector<int> children(clip.skeleton.joints.size(), 0);
  for (const Joint& joint : clip.skeleton.joints)
    if (joint.parent_idx >= 0) ++children[static_cast<std::size_t>(joint.parent_idx)];
  int j = parent_of(clip, reach.joint);
  for (; j >= 0 && parent_of(clip, j) >= 0 && (reach.chain.empty() || children[static_cast<std::size_t>(j)] < 2);
       j = parent_of(clip, j))
    reach.chain.push_back(j);
  reach.limb_size = reach.chain.size();
  const auto carries_body = [&](int k) {
    return parent_of(clip, k) < 0 || has_position_channels(clip.skeleton.joints[static_cast<std::size_t>(k)]);
  };
  if (!reach.chain.empty())
    for (; j >= 0 && !carries_body(j); j = parent_of(clip, j)) reach.chain.push_back(j);
  reach.turns.assign(reach.chain.size(), Vector3::Zero());
}

Reach make_reach(const Clip& clip, const LimbTarget& target, Index ease, std::span<const Index> pinned) {
  Reach reach;
  reach.target = &target;
  reach.joint = clip.skeleton.find(target.joint);
  const std::string what = target.joint + " at frame " + std::to_string(target.frame);
  if (reach.joint < 0) {
    std::string names;
    for (const Joint& joint : clip.skeleton.joints) names += (names.empty() ? "" : ", ") + joint.name;
    throw InvalidInput("there is no joint '" + target.joint + "'; the skeleton has " + names);
  }
  if (target.frame < 0 || target.frame >= clip.num_frames())
    throw InvalidInput(what + ": the clip has frames 0 … " + std::to_string(clip.num_frames() - 1));
  if (!target.position.allFinite()) throw InvalidInput(what + ": the place is not finite");
  if (std::find(pinned.begin(), pinned.end(), target.frame) != pinned.end())
    throw InvalidInput(what + ": the pose of this frame is given, it cannot reach elsewhere");
  find_chain(clip, reach);
  if (reach.chain.empty())
    throw InvalidInput("'" + target.joint + "' has no limb that could bring it to a place; lead the root instead");
  reach.first = target.frame - ease, reach.last = target.frame + ease;
  for (const Index frame : pinned) {
    if (frame < target.frame) reach.first = std::max(reach.first, frame);
    if (frame > target.frame) reach.last = std::min(reach.last, frame);
  }
  return reach;
}

/// A frame of `source` with the turns of all reaches that are at work there.
void turn_joints(const Clip& source, Index frame, const std::vector<Reach>& reaches, Clip& out, Index out_frame) {
  out.translations.row(out_frame) = source.translations.row(frame);
  out.rotations.row(out_frame) = source.rotations.row(frame);
  for (const Reach& reach : reaches) {
    const double w = reach.weight(frame);
    if (w == 0) continue;
    for (std::size_t k = 0; k < reach.chain.size(); ++k)
      if (!reach.turns[k].isZero(0))
        out.set_rotation(out_frame, reach.chain[k],
                         (out.rotation(out_frame, reach.chain[k]) * exp_map(w * reach.turns[k])).normalized());
  }
}

/// Turns the chain a little so that the joint comes nearer to its place: δ += W Jᵀ (J W Jᵀ + λ² I)⁻¹ e.
double step(const Pose& pose, double length, Reach& reach) {
  const Vector3 tip = pose.positions.col(reach.joint), error = reach.target->position - tip;
  const std::size_t used = reach.with_spine ? reach.chain.size() : reach.limb_size;
  Eigen::Matrix3d gram = Eigen::Matrix3d::Identity() * std::pow(kDamping * length, 2);
  std::vector<Eigen::Matrix3d> columns(used);
  for (std::size_t k = 0; k < used; ++k) {
    const Vector3 arm = tip - pose.positions.col(reach.chain[k]);
    const Eigen::Matrix3d axes = pose.rotation(reach.chain[k]).toRotationMatrix();
    for (int i = 0; i < 3; ++i) columns[k].col(i) = axes.col(i).cross(arm);
    gram += (k < reach.limb_size ? 1 : kSpineWeight) * columns[k] * columns[k].transpose();
  }
  const Vector3 pull = gram.inverse() * error;
  for (std::size_t k = 0; k < used; ++k) {
    Vector3 turn = (k < reach.limb_size ? 1 : kSpineWeight) * columns[k].transpose() * pull;
    if (turn.norm() > kMostTurn) turn *= kMostTurn / turn.norm();
    reach.turns[k] = log_map(exp_map(reach.turns[k]) * exp_map(turn));
  }
  return error.norm();
}

double distance(const Pose& pose, const Reach& reach) {
  return (reach.target->position - pose.positions.col(reach.joint)).norm();
}

/// Turns all chains until every target is met, or nothing comes nearer any more.
void solve(const Clip& source, double cm_per_unit, std::vector<Reach>& reaches, const JobContext& job) {
  Clip work = slice(source, 0, 1);
  Pose pose;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    job.check_cancelled();
    double worst = 0;
    for (Reach& reach : reaches) {
      double length = 0;
      for (std::size_t k = 0; k < reach.limb_size; ++k)
        length += source.translation(reach.target->frame, k == 0 ? reach.joint : reach.chain[k - 1]).norm();
      double missing = 0;
      for (int k = 0; k < kSteps; ++k) {
        turn_joints(source, reach.target->frame, reaches, work, 0);
        forward_kinematics(work, 0, pose);
        missing = distance(pose, reach) * cm_per_unit;
        if (missing < kMetCm) break;
        step(pose, length, reach);
      }
      // What the limb alone does not do in some rounds is beyond it.
      if (missing > 0.1 * kMissedCm && sweep >= 6) reach.with_spine = true;
      worst = std::max(worst, missing);
    }
    if (worst < kMetCm) break;
  }
}

/// Rotation in its parent's frame that leaves the joint as it was in the world.
void keep_rotation(const Clip& before, Index frame, int joint, Clip& out) {
  Pose was, is;
  forward_kinematics(before, frame, was);
  forward_kinematics(out, frame, is);
  const int parent = parent_of(out, joint);
  out.set_rotation(frame, joint, (is.rotation(parent).conjugate() * was.rotation(joint)).normalized());
}

/// The joint is itself turned for another target.
bool turns(const std::vector<Reach>& reaches, int joint) {
  return std::any_of(reaches.begin(), reaches.end(), [joint](const Reach& reach) {
    return std::find(reach.chain.begin(), reach.chain.end(), joint) != reach.chain.end();
  });
}

}  // namespace

std::vector<ReachedTarget> reach_targets(Clip& clip, std::span<const LimbTarget> targets, const ReachOptions& options,
                                         std::span<const Index> pinned, const JobContext& job) {
  check_options(options);
  const Index ease = std::max<Index>(1, std::lround(options.reach_ease / clip.frame_time_secs));
  std::vector<Reach> reaches;
  for (const LimbTarget& target : targets) {
    for (const Reach& other : reaches)
      if (other.target->frame == target.frame && other.target->joint == target.joint)
        throw InvalidInput("two places are asked for " + target.joint + " at frame " + std::to_string(target.frame));
    reaches.push_back(make_reach(clip, target, ease, pinned));
  }
  if (reaches.empty()) return {};
  const double cm_per_unit = 100 * metres_per_unit_or_guess(clip.skeleton);
  const Clip source = clip;
  solve(source, cm_per_unit, reaches, job);
  std::vector<bool> done(static_cast<std::size_t>(clip.num_frames()), false);
  for (const Reach& reach : reaches)
    for (Index t = std::max<Index>(0, reach.first + 1); t < std::min(clip.num_frames(), reach.last); ++t)
      if (!done[static_cast<std::size_t>(t)]) {
        turn_joints(source, t, reaches, clip, t);
        for (const Reach& r : reaches)
          if (r.weight(t) > 0 && !turns(reaches, r.joint)) keep_rotation(source, t, r.joint, clip);
        done[static_cast<std::size_t>(t)] = true;
      }
  std::vector<ReachedTarget> out;
  Pose pose;
  for (const Reach& reach : reaches) {
    ReachedTarget reached;
    forward_kinematics(source, reach.target->frame, pose);
    reached.distance_before = distance(pose, reach);
    forward_kinematics(clip, reach.target->frame, pose);
    reached.distance_after = distance(pose, reach);
    for (std::size_t k = 0; k < reach.chain.size(); ++k)
      if (!reach.turns[k].isZero(0)) reached.joints.push_back(reach.chain[k]);
    const double missed = reached.distance_after * cm_per_unit;
    if (missed > kMissedCm)
      job.warn(reach.target->joint + " cannot be there at frame " + std::to_string(reach.target->frame) +
               ": it comes as near as " + std::to_string(std::lround(missed)) + " cm");
    out.push_back(std::move(reached));
  }
  return out;
}

}  // namespace motex
