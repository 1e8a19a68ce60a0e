// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/retarget.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "motex/core/error.h"
#include "motex/core/options_check.h"
#include "motex/motion/contacts.h"
#include "motex/motion/foot_fix.h"

namespace motex {
namespace {

constexpr double kNoLength = 1e-9;
constexpr double kStanding = 0.7;  // cosine: a shank that points down at least this much belongs to a standing body

std::size_t at(int idx) { return static_cast<std::size_t>(idx); }
Vector3 position(const Pose& pose, int joint) { return pose.positions.col(joint); }

/// The rotation R that maximises Σ to_k · R from_k; among equals nearly the one nearest to none (Horn 1987).
Quat best_turn(const std::vector<Vector3>& from, const std::vector<Vector3>& to) {
  Eigen::Matrix3d s = 1e-9 * Eigen::Matrix3d::Identity();
  for (std::size_t k = 0; k < from.size(); ++k) s += from[k] * to[k].transpose();
  Eigen::Matrix4d n;
  n << s.trace(), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0),   //
      0, s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2),  //
      0, 0, s(1, 1) - s(0, 0) - s(2, 2), s(1, 2) + s(2, 1),                  //
      0, 0, 0, s(2, 2) - s(0, 0) - s(1, 1);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(Eigen::Matrix4d(n.selfadjointView<Eigen::Upper>()));
  const Eigen::Vector4d q = solver.eigenvectors().col(3);
  return Quat(q[0], q[1], q[2], q[3]).normalized();
}

std::optional<Vector3> direction(const Pose& pose, int from, int to) {
  const Vector3 d = position(pose, to) - position(pose, from);
  if (d.norm() < kNoLength) return std::nullopt;
  return d.normalized();
}

/// A leg of both bodies; the target's foot is the joint that takes from the source's ankle.
struct LegPair {
  Leg source;
  int hip = -1, knee = -1, ankle = -1;  // of the target
};

class Retargeter {
 public:
  Retargeter(const Clip& source, const Pose& source_pose, const PosedSkeleton& target, const JointMap& map,
             const RetargetOptions& options, RetargetReport& report, const JobContext& job)
      : source_(source),
        source_pose_(source_pose),
        target_(target),
        map_(map),
        options_(options),
        report_(report),
        job_(job) {}

  Clip run() {
    check();
    list_joints_left_out();
    find_feet();
    find_children();
    align_postures();
    find_travelling_joint();
    find_scale();
    Clip out = turn_frames();
    lift(out);
    hold_feet(out);
    return out;
  }

 private:
  void check() const;
  void list_joints_left_out();
  void find_feet();
  void find_children();
  void align_postures();
  bool align_foot(int joint);
  std::optional<Vector3> tip_direction(const Skeleton& skeleton, const Pose& pose, int joint) const;
  void find_travelling_joint();
  void find_scale();
  double leg_ratio() const;
  double bone_ratio() const;
  Clip turn_frames();
  void place_travelling_joint(const Pose& source, const Pose& pose, Clip& out, Index t) const;
  void measure_directions(const Pose& source, const Pose& target);
  FootModel feet_of(const Clip& clip) const;
  void lift(Clip& out);
  void hold_feet(Clip& out);
  int source_of(int joint) const { return map_.source_of[at(joint)]; }
  int parent(int joint) const { return target_.skeleton.joints[at(joint)].parent_idx; }
  /// The only bone by which the joint's direction is known: a child, or −1.
  int limb(int joint) const { return children_[at(joint)].size() == 1 ? children_[at(joint)][0] : -1; }

  const Clip& source_;
  const Pose& source_pose_;
  const PosedSkeleton& target_;
  const JointMap& map_;
  const RetargetOptions& options_;
  RetargetReport& report_;
  const JobContext& job_;
  FootModel source_feet_, target_feet_;
  std::vector<LegPair> legs_;
  std::vector<std::vector<int>> children_;  // next joints below that have a source, by joint of the target
  std::vector<Quat> align_;                 // D
  int travelling_source_ = 0, travelling_ = 0;
  double error_sum_ = 0;
  Index num_errors_ = 0;
};

void Retargeter::check() const {
  check_clip(source_);
  check_skeleton(target_.skeleton);
  check_options(options_);
  const auto joints = target_.skeleton.joints.size();
  const auto fits = [&](int s) { return s >= -1 && s < source_.skeleton.num_joints(); };
  if (map_.source_of.size() != joints || !std::all_of(map_.source_of.begin(), map_.source_of.end(), fits) ||
      target_.pose.positions.cols() != static_cast<Index>(joints) ||
      source_pose_.positions.cols() != source_.skeleton.num_joints())
    throw InvalidInput("the joint map or a posture belongs to other skeletons");
  if (map_.num_matched() < 2)
    throw InvalidInput(
        source_.name + ": " + (map_.num_matched() == 0 ? "no joint" : "only one joint") +
        " has a counterpart in the skeleton to go to; name the pairs in a map (--write-map to start one)");
}

void Retargeter::list_joints_left_out() {
  for (std::size_t j = 0; j < map_.source_of.size(); ++j)
    if (map_.source_of[j] < 0) report_.unmatched.push_back(target_.skeleton.joints[j].name);
  for (int s = 0; s < source_.skeleton.num_joints(); ++s)
    if (map_.target_of(s) < 0) report_.unused.push_back(source_.skeleton.joints[at(s)].name);
}

void Retargeter::find_feet() {
  source_feet_ = learn_foot_model(std::span(&source_, 1), {}, job_);
  for (const Leg& leg : source_feet_.legs) {
    const LegPair pair{leg, map_.target_of(leg.hip_idx), map_.target_of(leg.knee_idx), map_.target_of(leg.ankle_idx)};
    if (pair.hip >= 0 && pair.ankle >= 0) legs_.push_back(pair);
  }
}

void Retargeter::find_children() {
  children_.resize(map_.source_of.size());
  for (int j = 0; j < target_.skeleton.num_joints(); ++j) {
    if (source_of(j) < 0) continue;
    int above = parent(j);
    while (above >= 0 && source_of(above) < 0) above = parent(above);
    const bool has_length =
        above >= 0 && direction(target_.pose, above, j) && direction(source_pose_, source_of(above), source_of(j));
    if (has_length) children_[at(above)].push_back(j);
  }
  for (const LegPair& leg : legs_) children_[at(leg.ankle)].clear();  // the sole counts, not where the toes begin
}

/// Towards the farthest point that is fixed to the joint.
std::optional<Vector3> Retargeter::tip_direction(const Skeleton& skeleton, const Pose& pose, int joint) const {
  Vector3 tip = Vector3::Zero();
  for (int j = 0; j < skeleton.num_joints(); ++j)
    if (skeleton.joints[at(j)].parent_idx == joint) {
      const Vector3 d = position(pose, j) - position(pose, joint);
      if (d.norm() > tip.norm()) tip = d;
    }
  for (const EndSite& site : skeleton.end_sites)
    if (site.parent_idx == joint && site.offset.norm() > tip.norm()) tip = pose.rotation(joint) * site.offset;
  if (tip.norm() < kNoLength) return std::nullopt;
  return tip.normalized();
}

/// A foot on the floor in both postures: its sole stays flat, its toes point where the other's do.
bool Retargeter::align_foot(int joint) {
  const auto leg = std::find_if(legs_.begin(), legs_.end(), [&](const LegPair& l) { return l.ankle == joint; });
  if (leg == legs_.end()) return false;
  const auto stands = [](const std::optional<Vector3>& shank) { return shank && -shank->y() > kStanding; };
  const int knee = leg->knee >= 0 ? leg->knee : leg->hip;
  if (!stands(direction(source_pose_, leg->source.knee_idx, leg->source.ankle_idx)) ||
      !stands(direction(target_.pose, knee, joint)))
    return false;
  const auto from = tip_direction(target_.skeleton, target_.pose, joint);
  const auto to = tip_direction(source_.skeleton, source_pose_, leg->source.ankle_idx);
  const auto level = [](const Vector3& d) { return std::hypot(d.x(), d.z()); };
  if (!from || !to || level(*from) < 0.5 || level(*to) < 0.5) return false;
  const double turn = std::atan2(to->x(), to->z()) - std::atan2(from->x(), from->z());
  align_[at(joint)] = Quat(Eigen::AngleAxisd(turn, Vector3::UnitY()));
  return true;
}

void Retargeter::align_postures() {
  align_.assign(map_.source_of.size(), Quat::Identity());
  for (int j = 0; j < target_.skeleton.num_joints(); ++j) {
    const Quat above = parent(j) >= 0 ? align_[at(parent(j))] : Quat::Identity();
    align_[at(j)] = above;
    if (source_of(j) < 0 || align_foot(j)) continue;
    std::vector<Vector3> from, to;
    for (const int child : children_[at(j)]) {
      from.push_back(above * *direction(target_.pose, j, child));
      to.push_back(*direction(source_pose_, source_of(j), source_of(child)));
    }
    if (from.empty()) continue;
    const Quat turn = from.size() == 1 ? Quat::FromTwoVectors(from[0], to[0]) : best_turn(from, to);
    align_[at(j)] = (turn * above).normalized();
  }
}

void Retargeter::find_travelling_joint() {
  travelling_source_ = source_feet_.legs.empty() ? 0 : source_feet_.pelvis_idx;
  travelling_ = map_.target_of(travelling_source_);
  if (travelling_ >= 0) return;
  const auto first = std::find_if(map_.source_of.begin(), map_.source_of.end(), [](int s) { return s >= 0; });
  travelling_ = static_cast<int>(first - map_.source_of.begin());
  travelling_source_ = *first;
}

double way(const Skeleton& skeleton, const Pose& pose, int from, int to) {
  double length = 0;
  for (int j = to; j >= 0 && j != from; j = skeleton.joints[at(j)].parent_idx) {
    const int up = skeleton.joints[at(j)].parent_idx;
    if (up >= 0) length += (position(pose, j) - position(pose, up)).norm();
  }
  return length;
}

double Retargeter::leg_ratio() const {
  double of_source = 0, of_target = 0;
  for (const LegPair& leg : legs_) {
    of_source += way(source_.skeleton, source_pose_, leg.source.hip_idx, leg.source.ankle_idx);
    of_target += way(target_.skeleton, target_.pose, leg.hip, leg.ankle);
  }
  return of_source > 0 ? of_target / of_source : 0;
}

double Retargeter::bone_ratio() const {
  double of_source = 0, of_target = 0;
  for (int j = 0; j < target_.skeleton.num_joints(); ++j)
    for (const int child : children_[at(j)]) {
      of_source += (position(source_pose_, source_of(child)) - position(source_pose_, source_of(j))).norm();
      of_target += (position(target_.pose, child) - position(target_.pose, j)).norm();
    }
  return of_source > 0 ? of_target / of_source : 0;
}

void Retargeter::find_scale() {
  double scale = options_.scale;
  if (scale == 0) scale = leg_ratio();
  if (!(scale > 0)) scale = bone_ratio();
  report_.scale = scale > 0 ? scale : 1;
}

void Retargeter::place_travelling_joint(const Pose& source, const Pose& pose, Clip& out, Index t) const {
  const Vector3 place = report_.scale * position(source, travelling_source_);
  const int up = parent(travelling_);
  if (up < 0)
    out.set_translation(t, travelling_, place);
  else
    out.set_translation(t, travelling_, pose.rotation(up).conjugate() * (place - position(pose, up)));
}

Clip Retargeter::turn_frames() {
  Clip out = make_clip(target_.skeleton, source_.num_frames(), source_.frame_time_secs);
  out.name = source_.name;
  const int joints = target_.skeleton.num_joints();
  Pose source, pose;
  for (Index t = 0; t < source_.num_frames(); ++t) {
    if (t % 256 == 0) job_.check_cancelled();
    forward_kinematics(source_, t, source);
    pose.positions.resize(3, joints);
    pose.rotations.resize(4, joints);
    for (int j = 0; j < joints; ++j) {
      const int up = parent(j), s = source_of(j);
      const Quat above = up >= 0 ? pose.rotation(up) : Quat::Identity();
      const Quat above0 = up >= 0 ? target_.pose.rotation(up) : Quat::Identity();
      const Vector3 origin = up >= 0 ? position(target_.pose, up) : Vector3::Zero();
      Quat world = above * above0.conjugate() * target_.pose.rotation(j);
      if (s >= 0) {
        Quat turned = source.rotation(s) * source_pose_.rotation(s).conjugate();
        // Between the two joints the source may have others, which bend.
        if (const int child = limb(j); child >= 0)
          if (const auto now = direction(source, s, source_of(child)))
            turned = Quat::FromTwoVectors(turned * *direction(source_pose_, s, source_of(child)), *now) * turned;
        world = turned * align_[at(j)] * target_.pose.rotation(j);
      }
      pose.rotations.col(j) = world.normalized().coeffs();
      out.set_rotation(t, j, (above.conjugate() * world).normalized());
      out.set_translation(t, j, above0.conjugate() * (position(target_.pose, j) - origin));
      if (j == travelling_) place_travelling_joint(source, pose, out, t);
      const Vector3 above_position = up >= 0 ? position(pose, up) : Vector3::Zero();
      pose.positions.col(j) = above_position + above * out.translation(t, j);
    }
    measure_directions(source, pose);
  }
  report_.mean_direction_error = num_errors_ > 0 ? error_sum_ / static_cast<double>(num_errors_) : 0;
  return out;
}

void Retargeter::measure_directions(const Pose& source, const Pose& target) {
  report_.num_limbs = 0;
  for (int j = 0; j < target_.skeleton.num_joints(); ++j) {
    const int child = limb(j);
    if (child < 0) continue;
    const auto a = direction(source, source_of(j), source_of(child)), b = direction(target, j, child);
    if (!a || !b) continue;
    const double error = std::atan2(a->cross(*b).norm(), a->dot(*b)) * 180 / std::numbers::pi;
    report_.max_direction_error = std::max(report_.max_direction_error, error);
    error_sum_ += error;
    ++num_errors_;
    ++report_.num_limbs;
  }
}

FootModel Retargeter::feet_of(const Clip& clip) const {
  std::vector<std::string> names;
  for (const LegPair& leg : legs_) names.push_back(target_.skeleton.joints[at(leg.ankle)].name);
  if (names.empty()) return {};
  try {
    return learn_foot_model(std::span(&clip, 1), names, {});
  } catch (const InvalidInput&) {
    return {};  // a leg of one bone: nothing to hold
  }
}

/// As high above the floor as the source is: ankles, and toes where both have them.
void Retargeter::lift(Clip& out) {
  target_feet_ = feet_of(out);
  const std::size_t legs = target_feet_.legs.size();
  if (legs == 0 || legs != legs_.size()) return;
  bool has_toes = true;
  for (std::size_t i = 0; i < legs; ++i)
    has_toes = has_toes && legs_[i].source.has_toe() && target_feet_.legs[i].has_toe();
  double source_low = 1e300, target_low = 1e300;
  for (std::size_t i = 0; i < legs; ++i) {
    const Leg &s = legs_[i].source, &t = target_feet_.legs[i];
    source_low = std::min({source_low, s.ankle_floor, has_toes ? s.toe_floor : s.ankle_floor});
    target_low = std::min({target_low, t.ankle_floor, has_toes ? t.toe_floor : t.ankle_floor});
  }
  report_.height_shift = report_.scale * source_low - target_low;
  // Of the world: the travelling joint may hang from others.
  Pose pose;
  for (Index t = 0; t < out.num_frames(); ++t) {
    forward_kinematics(out, t, pose);
    const Quat above = parent(travelling_) >= 0 ? pose.rotation(parent(travelling_)) : Quat::Identity();
    out.set_translation(t, travelling_,
                        out.translation(t, travelling_) + above.conjugate() * Vector3(0, report_.height_shift, 0));
  }
  target_feet_ = feet_of(out);
}

void Retargeter::hold_feet(Clip& out) {
  if (!options_.foot_fix || target_feet_.legs.empty()) return;
  Clip as_it_was = source_;
  report_.source_contact_speed = report_.scale * fix_feet(as_it_was, source_feet_).contact_speed_before;
  const FootFixReport fix = fix_feet(out, target_feet_);
  report_.contact_speed_before = fix.contact_speed_before;
  report_.contact_speed_after = fix.contact_speed_after;
}

}  // namespace

PosedSkeleton at_rest(const Skeleton& skeleton) { return at_frame(make_clip(skeleton, 1, 1), 0); }

PosedSkeleton as_bound(const Skeleton& skeleton) {
  PosedSkeleton out = at_rest(skeleton);
  if (!skeleton.skin) return out;
  std::map<std::string, Quat> turns;
  for (const SkinJoint& joint : skeleton.skin->joints) turns.emplace(joint.name, joint.rotation);
  for (int j = 0; j < skeleton.num_joints(); ++j) {
    const Joint& joint = skeleton.joints[at(j)];
    const Quat above = joint.parent_idx >= 0 ? out.pose.rotation(joint.parent_idx) : Quat::Identity();
    const auto turn = turns.find(joint.name);
    out.pose.rotations.col(j) = (turn != turns.end() ? turn->second : above).coeffs();
    if (joint.parent_idx >= 0)
      out.pose.positions.col(j) = out.pose.positions.col(joint.parent_idx) + above * joint.offset;
  }
  return out;
}

PosedSkeleton at_frame(const Clip& clip, Index frame) {
  if (frame < 0 || frame >= clip.num_frames())
    throw InvalidInput(clip.name + " has no frame " + std::to_string(frame) + "; it has " +
                       std::to_string(clip.num_frames()));
  PosedSkeleton out{clip.skeleton, {}};
  forward_kinematics(clip, frame, out.pose);
  return out;
}

Clip retarget(const Clip& source, const Pose& source_pose, const PosedSkeleton& target, const JointMap& map,
              const RetargetOptions& options, RetargetReport& report, const JobContext& job) {
  report = {};
  return Retargeter(source, source_pose, target, map, options, report, job).run();
}

}  // namespace motex
