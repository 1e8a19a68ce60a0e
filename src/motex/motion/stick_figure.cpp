// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/stick_figure.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "motex/core/error.h"
#include "motex/core/rng.h"

namespace motex {
namespace {

constexpr double kThigh = 42, kShank = 42;
constexpr double kHipHalfWidth = 9;
constexpr double kAnkleHeight = 8;
constexpr double kHipsHeight = 84;
constexpr double kBob = 1.5;
constexpr double kLift = 9;
constexpr double kTau = 2 * std::numbers::pi;

Quat turn(double heading) { return Quat(Eigen::AngleAxisd(heading, Vector3::UnitY())); }

struct Walk {
  const StickFigureOptions& o;
  double cycle_secs;

  double heading(double t) const { return o.turn_rate * t; }
  Vector3 path(double t) const {
    const double w = o.turn_rate;
    if (std::abs(w * t) < 1e-9) return {0, 0, o.speed * t};
    return {o.speed / w * (1 - std::cos(w * t)), 0, o.speed / w * std::sin(w * t)};
  }
};

struct Foot {
  Vector3 ankle;
  Quat rotation;
  bool planted;
};

/// foot: 0 = left (+X), 1 = right.
Foot foot_at(const Walk& walk, int foot, double t) {
  const double phase = t / walk.cycle_secs + 0.5 * foot;
  const double cycle = std::floor(phase);
  const double in_cycle = phase - cycle;
  const double side = foot == 0 ? kHipHalfWidth : -kHipHalfWidth;
  const double duty = walk.o.stance;
  const auto print = [&](double n, double& heading) {
    const double middle = (n - 0.5 * foot + duty / 2) * walk.cycle_secs;
    heading = walk.heading(middle);
    return Vector3(walk.path(middle) + turn(heading) * Vector3(side, kAnkleHeight, 0));
  };
  double from_heading = 0, to_heading = 0;
  const Vector3 from = print(cycle, from_heading);
  if (in_cycle < duty) return {from, turn(from_heading), true};
  const Vector3 to = print(cycle + 1, to_heading);
  const double u = (in_cycle - duty) / (1 - duty);
  const double ease = u * u * u * (10 + u * (6 * u - 15));
  const double bump = 16 * u * u * (1 - u) * (1 - u);
  const double pitch = 0.5 * bump * std::cos(kTau / 2 * u);
  return {Vector3(from + ease * (to - from) + Vector3(0, kLift * bump, 0)),
          turn(from_heading + ease * (to_heading - from_heading)) * Quat(Eigen::AngleAxisd(pitch, Vector3::UnitX())),
          false};
}

/// Frame whose −Y axis points along `down` and whose X axis is as near to `side` as that allows.
Quat limb_rotation(const Vector3& down, const Vector3& side) {
  Eigen::Matrix3d axes;
  axes.col(1) = -down.normalized();
  axes.col(2) = side.cross(axes.col(1)).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return Quat(axes).normalized();
}

struct Leg3 {
  Quat thigh, shank;  // in the world
};

Leg3 solve_leg(const Vector3& hip, const Vector3& ankle, const Vector3& forward) {
  const Vector3 reach = ankle - hip;
  const double c = reach.norm();
  if (c >= kThigh + kShank) throw InvalidInput("the stick figure's steps are longer than its legs allow");
  const Vector3 along = reach / c;
  const Vector3 side = (-along).cross(forward).normalized();
  const Vector3 out = side.cross(-along).normalized();
  const double x = (c * c + kThigh * kThigh - kShank * kShank) / (2 * c);
  const Vector3 knee = hip + along * x + out * std::sqrt(kThigh * kThigh - x * x);
  return {limb_rotation(knee - hip, side), limb_rotation(ankle - knee, side)};
}

/// Slow movement of one angle: four sinusoids of 0.2 … 1.5 Hz with random amplitude and phase.
class SlowNoise {
 public:
  SlowNoise(Rng rng, double deviation) {
    for (auto& wave : waves_)
      wave = {deviation / 2 * rng.normal() * std::numbers::sqrt2, kTau * rng.uniform(0.2, 1.5), kTau * rng.uniform()};
  }
  double at(double t) const {
    double sum = 0;
    for (const auto& [amplitude, rate, phase] : waves_) sum += amplitude * std::sin(rate * t + phase);
    return sum;
  }

 private:
  std::array<std::array<double, 3>, 4> waves_;
};

Quat upper_body(const std::string& name, double swing, double elbow) {
  const auto about = [](const Vector3& axis, double angle) { return Quat(Eigen::AngleAxisd(angle, axis)); };
  if (name == "Spine") return about(Vector3::UnitX(), 0.05) * about(Vector3::UnitY(), 0.1 * swing);
  if (name == "LeftArm") return about(Vector3::UnitX(), 0.5 * swing);
  if (name == "RightArm") return about(Vector3::UnitX(), -0.5 * swing);
  if (name == "LeftForeArm" || name == "RightForeArm") return about(Vector3::UnitX(), -elbow);
  return Quat::Identity();
}

void pose_frame(const Walk& walk, const std::vector<SlowNoise>& noise, Index frame, StickFigure& figure) {
  Clip& clip = figure.clip;
  const Skeleton& skeleton = clip.skeleton;
  const double t = static_cast<double>(frame) * clip.frame_time_secs;
  const double swing = std::sin(kTau * t / walk.cycle_secs);
  const double bob = kBob * std::cos(2 * kTau * (t / walk.cycle_secs - walk.o.stance / 2));
  const Vector3 hips = walk.path(t) + Vector3(0, kHipsHeight + bob, 0);
  const Quat facing = turn(walk.heading(t) + 0.05 * swing);
  clip.set_translation(frame, 0, hips);
  clip.set_rotation(frame, 0, facing);
  for (int j = 1; j < 9; ++j) {
    const auto n = static_cast<std::size_t>(3 * j);
    const Quat slow = exp_map(Vector3(noise[n].at(t), noise[n + 1].at(t), noise[n + 2].at(t)));
    clip.set_rotation(frame, j, upper_body(skeleton.joints[static_cast<std::size_t>(j)].name, swing, 0.4) * slow);
  }
  for (int f = 0; f < 2; ++f) {
    const int thigh = 9 + 4 * f;
    const Foot foot = foot_at(walk, f, t);
    const Vector3 hip = hips + facing * skeleton.joints[static_cast<std::size_t>(thigh)].offset;
    const Leg3 leg = solve_leg(hip, foot.ankle, facing * Vector3::UnitZ());
    clip.set_rotation(frame, thigh, (facing.conjugate() * leg.thigh).normalized());
    clip.set_rotation(frame, thigh + 1, (leg.thigh.conjugate() * leg.shank).normalized());
    clip.set_rotation(frame, thigh + 2, (leg.shank.conjugate() * foot.rotation).normalized());
    figure.planted[static_cast<std::size_t>(2 * frame + f)] = foot.planted ? 1 : 0;
  }
}

}  // namespace

Skeleton stick_figure_skeleton() {
  Skeleton s;
  s.metres_per_unit = 0.01;
  const auto add = [&](const std::string& name, int parent, const Vector3& offset) {
    Joint joint{name, parent, offset, {Channel::kZRotation, Channel::kXRotation, Channel::kYRotation}};
    if (parent < 0)
      joint.channels.insert(joint.channels.begin(), {Channel::kXPosition, Channel::kYPosition, Channel::kZPosition});
    s.joints.push_back(joint);
    return s.num_joints() - 1;
  };
  const auto tip = [&](int parent, const Vector3& offset) { s.end_sites.push_back({parent, offset}); };
  const int hips = add("Hips", -1, Vector3::Zero());
  const int spine = add("Spine", hips, {0, 12, 0});
  tip(add("Head", spine, {0, 48, 0}), {0, 20, 0});
  for (const auto& [name, side] : {std::pair<std::string, double>{"Left", 1}, {"Right", -1}}) {
    const int arm = add(name + "Arm", spine, {18 * side, 38, 0});
    const int fore_arm = add(name + "ForeArm", arm, {2 * side, -28, 0});
    tip(add(name + "Hand", fore_arm, {0, -25, 0}), {0, -16, 0});
  }
  for (const auto& [name, side] : {std::pair<std::string, double>{"Left", 1}, {"Right", -1}}) {
    const int thigh = add(name + "UpLeg", hips, {kHipHalfWidth * side, -2, 0});
    const int shank = add(name + "Leg", thigh, {0, -kThigh, 0});
    const int foot = add(name + "Foot", shank, {0, -kShank, 0});
    tip(add(name + "ToeBase", foot, {0, -6, 13}), {0, -1, 6});
  }
  return s;
}

StickFigure walk_stick_figure(const StickFigureOptions& options) {
  if (options.num_frames < 1 || !(options.speed > 0) || !(options.step_length > 0) || !(options.frame_rate > 0) ||
      !(options.stance > 0.5) || !(options.stance < 1))
    throw InvalidInput("the stick figure needs frames, a positive speed, step and rate, and a stance of 0.5 … 1");
  StickFigure figure;
  figure.clip = make_clip(stick_figure_skeleton(), options.num_frames, 1 / options.frame_rate);
  figure.clip.name = "stick_figure";
  figure.planted.resize(static_cast<std::size_t>(2 * options.num_frames));
  const Walk walk{options, 2 * options.step_length / options.speed};
  const Rng rng(options.seed);
  std::vector<SlowNoise> noise;
  for (std::uint64_t i = 0; i < 27; ++i) noise.emplace_back(rng.fork(i), options.noise);
  for (Index t = 0; t < options.num_frames; ++t) pose_frame(walk, noise, t, figure);
  return figure;
}

}  // namespace motex
