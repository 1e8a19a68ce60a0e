// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/actor_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motex/core/error.h"
#include "motex/motion_io/bvh.h"
#include "motex/project/puppet_moves.h"

namespace motex {
namespace {

using std::numbers::pi;

constexpr double kMetres = 0.01;  // a unit of the file
constexpr double kAnkleHeight = 0.08, kTipHeight = 0.02;

/// Frames of puppet_moves.bvh; a synthetic action has none.
struct Action {
  const char* name;
  int first, last;
  double secs;
  int num_turns;
};
constexpr int kLastIdle = 79;
constexpr Action kActions[] = {
    {"steps", 80, 147, 0, 0},    {"turn", 148, 203, 0, -1},    {"arms", 204, 261, 0, 0},
    {"left_kick", 0, 0, 1.4, 0}, {"right_kick", 0, 0, 1.4, 0}, {"bow", 0, 0, 2.2, 0},
};

double smooth(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (x * (6 * x - 15) + 10);
}

/// 0 … 1 → 0 … 1 at an even pace that rises over the first `ramp` and falls over the last.
double eased(double x, double ramp) {
  const double full = 1 - ramp;  // time at full pace that covers the same way
  if (x < ramp) return 0.5 * x * x / ramp / full;
  if (x > 1 - ramp) return 1 - 0.5 * (1 - x) * (1 - x) / ramp / full;
  return (x - 0.5 * ramp) / full;
}

/// Rises from `from`, stands at 1 between `up` and `down`, is back at `to`.
double plateau(double x, double from, double up, double down, double to) {
  return smooth((x - from) / (up - from)) * (1 - smooth((x - down) / (to - down)));
}

double heading_of(const Quat& q) { return 2 * std::atan2(q.y(), q.w()); }
Quat about_y(double angle) { return Quat(Eigen::AngleAxisd(angle, Vector3::UnitY())); }

}  // namespace

const std::vector<std::string>& actor_actions() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const Action& action : kActions) out.emplace_back(action.name);
    return out;
  }();
  return names;
}

ActorBody::ActorBody() : clip_(read_bvh_bytes(kPuppetMoves, "puppet_moves.bvh")) {
  double last = 0;
  for (Index frame = 0; frame < clip_.num_frames(); ++frame) {
    double heading = heading_of(clip_.rotation(frame, 0));
    heading += 2 * pi * std::round((last - heading) / (2 * pi));
    headings_.push_back(last = heading);
  }
}

double ActorBody::duration_secs(int action) const {
  const Action& one = kActions[action];
  return one.secs > 0 ? one.secs : (one.last - one.first) * clip_.frame_time_secs;
}

int ActorBody::column(const std::string& joint) const {
  const int idx = clip_.skeleton.find(joint);
  if (idx < 0) throw InvalidInput("puppet_moves.bvh: there is no joint " + joint);
  return idx;
}

int ActorBody::tip_column(const std::string& joint) const {
  const int parent = column(joint);
  const auto& sites = clip_.skeleton.end_sites;
  for (std::size_t k = 0; k < sites.size(); ++k)
    if (sites[k].parent_idx == parent) return clip_.skeleton.num_joints() + static_cast<int>(k);
  throw InvalidInput("puppet_moves.bvh: nothing is beyond " + joint);
}

ActorBody::Stance ActorBody::captured(double frame) const {
  const auto first =
      static_cast<Index>(std::clamp(std::floor(frame), 0.0, static_cast<double>(clip_.num_frames() - 2)));
  const double weight = std::clamp(frame - static_cast<double>(first), 0.0, 1.0);
  Stance stance;
  const auto at = static_cast<std::size_t>(first);
  stance.heading = headings_[at] + weight * (headings_[at + 1] - headings_[at]);
  stance.root = kMetres * ((1 - weight) * clip_.translation(first, 0) + weight * clip_.translation(first + 1, 0));
  for (int joint = 0; joint < clip_.skeleton.num_joints(); ++joint)
    stance.rotations.push_back(clip_.rotation(first, joint).slerp(weight, clip_.rotation(first + 1, joint)));
  stance.rotations[0] = about_y(-stance.heading) * stance.rotations[0];
  return stance;
}

ActorBody::Stance ActorBody::idle(const Moment& moment) const {
  // Slowly to and fro over the seconds in which it stood: never twice the same.
  const double t = moment.idle_secs, phase = moment.idle_phase;
  const double frame = 0.5 * kLastIdle + 0.31 * kLastIdle * std::sin(2 * pi * t / 11.3 + phase) +
                       0.17 * kLastIdle * std::sin(2 * pi * t / 6.1 + 2.3 * phase);
  Stance stance = captured(frame);
  const Stance middle = captured(0.5 * kLastIdle);
  stance.root -= Vector3(middle.root.x(), 0, middle.root.z());
  stance.heading = 0.3 * (stance.heading - middle.heading);
  turn(stance, "chest", {-0.012 * std::sin(2 * pi * t / 3.7 + phase), 0, 0});  // breath
  turn(stance, "lShldr", {0, 0, 0.01 * std::sin(2 * pi * t / 3.7 + phase)});
  turn(stance, "rShldr", {0, 0, -0.01 * std::sin(2 * pi * t / 3.7 + phase)});
  return stance;
}

void ActorBody::turn(Stance& stance, const char* joint, const Vector3& rotation_vector) const {
  Quat& rotation = stance.rotations[static_cast<std::size_t>(column(joint))];
  rotation = rotation * exp_map(rotation_vector);
}

void ActorBody::perform_capture(const Moment& moment, Stance& stance) const {
  const Action& action = kActions[moment.action];
  const double length = action.last - action.first;
  const double share = eased(moment.share, 0.12);
  const Stance from = captured(action.first), to = captured(action.last);
  const Stance now = captured(action.first + share * length);
  // What heading and place have not come back by is taken out evenly.
  const double turned = to.heading - from.heading;
  stance.heading += now.heading - from.heading + share * (2 * pi * action.num_turns - turned);
  // Away from where it began, as seen by one who stood along +Z then.
  Vector3 way = about_y(-from.heading) * (now.root - from.root - share * (to.root - from.root));
  way.y() = 0;
  stance.root += moment.amplitude * way;
  const double weight = moment.amplitude * smooth(moment.share / 0.18) * smooth((1 - moment.share) / 0.18);
  for (std::size_t k = 0; k < stance.rotations.size(); ++k)
    stance.rotations[k] = stance.rotations[k].slerp(weight, now.rotations[k]);
}

void ActorBody::perform_turned_joints(const Moment& moment, Stance& stance) const {
  const double x = moment.share, size = moment.amplitude;
  const std::string name = kActions[moment.action].name;
  if (name == "bow") {
    const double bend = size * plateau(x, 0, 0.4, 0.6, 1);
    turn(stance, "abdomen", {0.55 * bend, 0, 0});
    turn(stance, "chest", {0.5 * bend, 0, 0});
    turn(stance, "neck", {0.35 * bend, 0, 0});
    turn(stance, "lShldr", {-0.5 * bend, 0, 0.2 * bend});
    turn(stance, "rShldr", {-0.5 * bend, 0, -0.2 * bend});
    return;
  }
  const bool left = name == "left_kick";
  const double side = left ? 1 : -1;
  const double lift = size * plateau(x, 0.05, 0.45, 0.55, 0.95), knee = size * plateau(x, 0.02, 0.3, 0.3, 0.5);
  const double fold = size * plateau(x, 0.5, 0.72, 0.72, 0.98);
  turn(stance, left ? "lThigh" : "rThigh", {-0.8 * lift, 0, side * 1.15 * lift});
  turn(stance, left ? "lShin" : "rShin", {1.3 * knee + 0.8 * fold, 0, 0});
  turn(stance, "abdomen", {0, 0, side * 0.28 * lift});
  turn(stance, "lShldr", {-0.3 * lift, 0, 0.7 * lift});
  turn(stance, "rShldr", {-0.3 * lift, 0, -0.7 * lift});
}

Eigen::Matrix<double, 3, Eigen::Dynamic> ActorBody::place(const Stance& stance) const {
  Clip body = make_clip(clip_.skeleton, 1, clip_.frame_time_secs);
  for (std::size_t k = 0; k < stance.rotations.size(); ++k)
    body.set_rotation(0, static_cast<int>(k), stance.rotations[k].normalized());
  body.set_rotation(0, 0, (about_y(stance.heading) * stance.rotations[0]).normalized());
  body.set_translation(0, 0, stance.root / kMetres);
  Pose pose;
  forward_kinematics(body, 0, pose);
  const int num_joints = clip_.skeleton.num_joints();
  const auto& sites = clip_.skeleton.end_sites;
  Eigen::Matrix<double, 3, Eigen::Dynamic> out(3, num_joints + static_cast<Index>(sites.size()));
  out.leftCols(num_joints) = kMetres * pose.positions;
  for (std::size_t k = 0; k < sites.size(); ++k) {
    const int parent = sites[k].parent_idx;
    out.col(num_joints + static_cast<Index>(k)) =
        kMetres * (pose.positions.col(parent) + pose.rotation(parent) * sites[k].offset);
  }
  // The foot that is lower stands on the floor.
  double lowest = 1e9;
  for (const char* foot : {"lFoot", "rFoot"})
    lowest = std::min({lowest, out(1, column(foot)) - kAnkleHeight, out(1, tip_column(foot)) - kTipHeight});
  out.row(1).array() -= lowest;
  return out;
}

Eigen::Matrix<double, 3, Eigen::Dynamic> ActorBody::positions(const Moment& moment) const {
  Stance stance = idle(moment);
  if (moment.action >= 0) {
    if (kActions[moment.action].secs > 0)
      perform_turned_joints(moment, stance);
    else
      perform_capture(moment, stance);
  }
  return place(stance);
}

}  // namespace motex
