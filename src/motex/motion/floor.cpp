// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/floor.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "motex/motion/foot_fix_solver.h"
#include "motex/motion/whole_clip.h"

namespace motex {
namespace {

constexpr double kReachSecs = 0.1;  // of the maximum, and of the average
constexpr double kSeenCm = 0.1;     // deeper than this counts as below
constexpr int kShares = 3;          // rounds in which the body takes over what legs cannot do

/// The joint, or a joint above it, is an ankle.
std::vector<bool> belongs_to_feet(const Skeleton& skeleton, const FootModel& model) {
  std::vector<bool> out(skeleton.joints.size(), false);
  for (const Leg& leg : model.legs) out[static_cast<std::size_t>(leg.ankle_idx)] = true;
  for (std::size_t j = 0; j < out.size(); ++j) {
    const int parent = skeleton.joints[j].parent_idx;
    if (parent >= 0 && out[static_cast<std::size_t>(parent)]) out[j] = true;
  }
  return out;
}

double lowest_floor(const FootModel& model) {
  double lowest = HUGE_VAL;
  for (const Leg& leg : model.legs)
    lowest = std::min({lowest, leg.ankle_floor, leg.has_toe() ? leg.toe_floor : leg.ankle_floor});
  return lowest;
}

double foot_depth(const Pose& pose, const Leg& leg) {
  const Vector3 ankle = pose.positions.col(leg.ankle_idx);
  double depth = std::max(0.0, leg.ankle_floor - ankle.y());
  if (leg.has_toe())
    depth = std::max(depth, leg.toe_floor - (ankle + pose.rotation(leg.ankle_idx) * leg.toe_offset).y());
  return depth;
}

double body_depth(const Skeleton& skeleton, const std::vector<bool>& in_feet, double floor, const Pose& pose) {
  double depth = 0;
  for (int j = 0; j < skeleton.num_joints(); ++j)
    if (!in_feet[static_cast<std::size_t>(j)]) depth = std::max(depth, floor - pose.positions(1, j));
  for (const EndSite& site : skeleton.end_sites)
    if (!in_feet[static_cast<std::size_t>(site.parent_idx)])
      depth = std::max(
          depth, floor - (pose.positions.col(site.parent_idx) + pose.rotation(site.parent_idx) * site.offset).y());
  return depth;
}

}  // namespace

void depths_below_floor(const Skeleton& skeleton, const FootModel& model, const Pose& pose, Eigen::Ref<Vector> depths) {
  depths.setZero();
  if (model.legs.empty()) return;
  const auto legs = static_cast<Index>(model.legs.size());
  for (Index l = 0; l < legs; ++l) depths[l] = foot_depth(pose, model.legs[static_cast<std::size_t>(l)]);
  depths[legs] = body_depth(skeleton, belongs_to_feet(skeleton, model), lowest_floor(model), pose);
}

struct FloorFixer::State {
  State(const FootModel& feet, const Skeleton& skeleton, double frame_time_secs);
  Index row(Index frame) const { return frame % ring.num_frames(); }
  Index num_legs() const { return static_cast<Index>(model.legs.size()); }
  void find_depths(const Clip& clip, Index frame, Eigen::Ref<Vector> out);
  double largest_near(Index frame, Index column) const;
  Vector lifts(Index frame) const;
  void lift(const Vector& by, Clip& out, Index frame);
  void count(const Clip& out, Index frame, double lifted);

  FootModel model;
  Index reach;
  std::vector<bool> in_feet;
  double floor;
  Clip ring;           // frame t is in row t mod capacity
  FrameMatrix depths;  // ring rows × (legs + 1)
  std::vector<std::uint8_t> pinned;
  Index pushed = 0, popped = 0;
  bool finished = false;
  Pose pose;
  FloorReport sums;
};

FloorFixer::State::State(const FootModel& feet, const Skeleton& skeleton, double frame_time_secs)
    : model(feet), reach(std::max<Index>(1, std::lround(kReachSecs / frame_time_secs))) {
  check_skeleton(skeleton);
  for (const Leg& leg : model.legs)
    for (const int j : {leg.hip_idx, leg.knee_idx, leg.ankle_idx, model.pelvis_idx})
      if (j < 0 || j >= skeleton.num_joints())
        throw InvalidInput("the foot model belongs to another skeleton: its legs are not in this one");
  if (model.legs.empty()) reach = 0;
  in_feet = belongs_to_feet(skeleton, model);
  floor = lowest_floor(model);
  ring = make_clip(skeleton, 4 * reach + 3, frame_time_secs);
  depths = FrameMatrix::Zero(ring.num_frames(), num_legs() + 1);
  pinned.assign(static_cast<std::size_t>(ring.num_frames()), 0);
}

void FloorFixer::State::find_depths(const Clip& clip, Index frame, Eigen::Ref<Vector> out) {
  out.setZero();
  if (num_legs() == 0) return;
  forward_kinematics(clip, frame, pose);
  for (Index l = 0; l < num_legs(); ++l) out[l] = foot_depth(pose, model.legs[static_cast<std::size_t>(l)]);
  out[num_legs()] = body_depth(clip.skeleton, in_feet, floor, pose);
}

double FloorFixer::State::largest_near(Index frame, Index column) const {
  double largest = 0;
  for (Index t = std::max<Index>(0, frame - reach); t <= std::min(pushed - 1, frame + reach); ++t)
    largest = std::max(largest, depths(row(t), column));
  return largest;
}

Vector FloorFixer::State::lifts(Index frame) const {
  Vector out = Vector::Zero(num_legs() + 1);
  double free = 1;
  for (Index t = std::max<Index>(0, frame - 2 * reach); t <= std::min(pushed - 1, frame + 2 * reach); ++t) {
    if (pinned[static_cast<std::size_t>(row(t))] == 0) continue;
    const double u = std::min(1.0, static_cast<double>(std::abs(t - frame)) / static_cast<double>(2 * reach));
    free = std::min(free, u * u * (3 - 2 * u));
  }
  if (free == 0) return out;
  for (Index c = 0; c <= num_legs(); ++c) {
    double total = 0;
    for (Index k = -reach; k <= reach; ++k) {
      const double weight = 1 - static_cast<double>(std::abs(k)) / static_cast<double>(reach + 1);
      out[c] += weight * largest_near(std::clamp<Index>(frame + k, 0, pushed - 1), c);
      total += weight;
    }
    out[c] *= free / total;
  }
  return out;
}

/// by: lift of each foot, and of the body.
void FloorFixer::State::lift(const Vector& by, Clip& out, Index frame) {
  forward_kinematics(out, frame, pose);
  double body = by[num_legs()];
  std::vector<LegSolution> solved(model.legs.size());
  double missing = 0;
  for (int round = 0; round < kShares; ++round) {
    missing = 0;
    for (Index l = 0; l < num_legs(); ++l) {
      const Leg& leg = model.legs[static_cast<std::size_t>(l)];
      const double foot = std::max(by[l], body);
      LegSolution& solution = solved[static_cast<std::size_t>(l)];
      solution = solve_leg(pose, leg, {0, body, 0}, {0, foot, 0});
      const Vector3 hip = pose.positions.col(leg.hip_idx), knee = pose.positions.col(leg.knee_idx),
                    ankle = pose.positions.col(leg.ankle_idx);
      const Vector3 found = hip + Vector3(0, body, 0) +
                            solution.thigh * (pose.rotation(leg.hip_idx).conjugate() * (knee - hip)) +
                            solution.shank * (pose.rotation(leg.knee_idx).conjugate() * (ankle - knee));
      missing = std::max(missing, ankle.y() + foot - found.y());
    }
    if (round + 1 < kShares) body += missing;
  }
  body += missing;  // legs and all
  const auto& joints = out.skeleton.joints;
  const auto above = [&](int j) {
    const int parent = joints[static_cast<std::size_t>(j)].parent_idx;
    return parent < 0 ? Quat::Identity() : pose.rotation(parent);
  };
  out.set_translation(
      frame, model.pelvis_idx,
      out.translation(frame, model.pelvis_idx) + above(model.pelvis_idx).conjugate() * Vector3(0, body, 0));
  for (Index l = 0; l < num_legs(); ++l) {
    const Leg& leg = model.legs[static_cast<std::size_t>(l)];
    const LegSolution& s = solved[static_cast<std::size_t>(l)];
    out.set_rotation(frame, leg.hip_idx, (above(leg.hip_idx).conjugate() * s.thigh).normalized());
    out.set_rotation(frame, leg.knee_idx, (s.thigh.conjugate() * s.shank).normalized());
    out.set_rotation(frame, leg.ankle_idx, (s.shank.conjugate() * pose.rotation(leg.ankle_idx)).normalized());
  }
  sums.largest_lift = std::max({sums.largest_lift, body, by.maxCoeff()});
}

void FloorFixer::State::count(const Clip& out, Index frame, double lifted) {
  const double seen = kSeenCm / model.cm_per_unit, before = depths.row(row(popped)).maxCoeff();
  double after = before;
  if (lifted > 0) {
    Vector now(num_legs() + 1);
    find_depths(out, frame, now);
    after = now.maxCoeff();
  }
  ++sums.num_frames;
  sums.num_below_before += before > seen ? 1 : 0;
  sums.num_below_after += after > seen ? 1 : 0;
  sums.deepest_before = std::max(sums.deepest_before, before);
  sums.deepest_after = std::max(sums.deepest_after, after);
}

FloorFixer::FloorFixer(const FootModel& model, const Skeleton& skeleton, double frame_time_secs)
    : state_(std::make_unique<State>(model, skeleton, frame_time_secs)) {}
FloorFixer::~FloorFixer() = default;
FloorFixer::FloorFixer(FloorFixer&&) noexcept = default;

void FloorFixer::push(const Clip& clip, Index frame, bool pin) {
  State& s = *state_;
  if (clip.rotations.cols() != s.ring.rotations.cols())
    throw InvalidInput(clip.name + ": the clip's skeleton is not the one that is kept above the floor");
  if (s.finished || s.pushed - s.popped > 2 * s.reach + 1)
    throw InvalidInput("frames must be popped before more are pushed");
  const Index r = s.row(s.pushed);
  s.ring.translations.row(r) = clip.translations.row(frame);
  s.ring.rotations.row(r) = clip.rotations.row(frame);
  s.pinned[static_cast<std::size_t>(r)] = pin ? 1 : 0;
  Vector depths(s.num_legs() + 1);
  s.find_depths(s.ring, r, depths);
  s.depths.row(r) = depths.transpose();
  ++s.pushed;
}

void FloorFixer::finish() { state_->finished = true; }

bool FloorFixer::pop(Clip& out, Index frame) {
  State& s = *state_;
  if (s.popped >= s.pushed || (!s.finished && s.popped + 2 * s.reach >= s.pushed)) return false;
  const Index r = s.row(s.popped);
  out.translations.row(frame) = s.ring.translations.row(r);
  out.rotations.row(frame) = s.ring.rotations.row(r);
  if (s.num_legs() > 0) {
    const Vector lifts = s.lifts(s.popped);
    if (lifts.maxCoeff() > 0) s.lift(lifts, out, frame);
    s.count(out, frame, lifts.maxCoeff());
  }
  ++s.popped;
  return true;
}

FloorReport FloorFixer::report() const { return state_->sums; }

FloorReport keep_above_floor(Clip& clip, const FootModel& model, std::span<const Index> pinned) {
  FloorFixer fixer(model, clip.skeleton, clip.frame_time_secs);
  fix_whole_clip(fixer, clip, pinned);
  return fixer.report();
}

}  // namespace motex
