// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_io/euler_channels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace motex {
namespace {

constexpr double kStill = 1e-9;      // share of its size by which a translation may leave its offset
constexpr double kSameAngle = 1e-7;  // radians

double near_turn(double angle, double near) {
  return angle + 2 * std::numbers::pi * std::round((near - angle) / (2 * std::numbers::pi));
}

// q = R_i(a): the angle about axis i of the rotation's part that turns about i.
double angle_about(const Quat& q, int axis) { return 2 * std::atan2(q.vec()[axis], q.w()); }

// q = R_i(a) R_j(b) = (cos a/2 cos b/2) + i (sin a/2 cos b/2) + j (cos a/2 sin b/2) ± k (sin a/2 sin b/2).
Vector3 two_angles(const EulerOrder& order, const Quat& q) {
  const int i = order.axis[0], j = order.axis[1], k = 3 - i - j;
  const double sign = (j - i + 3) % 3 == 1 ? 1 : -1;
  const bool small_b = std::hypot(q.w(), q.vec()[i]) >= std::hypot(q.vec()[j], q.vec()[k]);
  const double a = small_b ? angle_about(q, i) : 2 * std::atan2(sign * q.vec()[k], q.vec()[j]);
  const Quat first(Eigen::AngleAxisd(a, Vector3::Unit(i)));
  return {a, angle_about(first.conjugate() * q, j), 0};
}

bool positions_fit(const Clip& clip, int joint) {
  const Joint& j = clip.skeleton.joints[static_cast<std::size_t>(joint)];
  for (int axis = 0; axis < 3; ++axis) {
    const auto channel = static_cast<Channel>(axis);
    if (std::find(j.channels.begin(), j.channels.end(), channel) != j.channels.end()) continue;
    const double offset = j.offset[axis];
    const double away = (clip.translations.col(3 * joint + axis).array() - offset).abs().maxCoeff();
    if (away > kStill * std::max(1.0, std::abs(offset))) return false;
  }
  return true;
}

bool rotations_fit(const Clip& clip, int joint, const std::vector<Channel>& channels) {
  EulerTrack track(channels);
  const EulerOrder order = euler_order(clip.skeleton.joints[static_cast<std::size_t>(joint)]);
  for (Index t = 0; t < clip.num_frames(); ++t) {
    const Quat q = clip.rotation(t, joint);
    if (angle_between(quat_from_euler(order, track.next(q)), q) > kSameAngle) return false;
  }
  return true;
}

}  // namespace

EulerTrack::EulerTrack(const std::vector<Channel>& channels) {
  Joint joint;
  joint.channels = channels;
  order_ = euler_order(joint);
  num_angles_ = static_cast<int>(
      channels.size() - static_cast<std::size_t>(std::count_if(channels.begin(), channels.end(), is_position)));
}

const Vector3& EulerTrack::next(const Quat& rotation) {
  if (num_angles_ == 3) {
    angles_ = euler_from_quat(order_, rotation, angles_);
    return angles_;
  }
  if (num_angles_ == 0) return angles_;
  const Vector3 found =
      num_angles_ == 1 ? Vector3(angle_about(rotation, order_.axis[0]), 0, 0) : two_angles(order_, rotation);
  for (int n = 0; n < num_angles_; ++n) angles_[n] = near_turn(found[n], angles_[n]);
  return angles_;
}

std::vector<Channel> channels_for_motion(const Clip& clip, int joint) {
  std::vector<Channel> channels = clip.skeleton.joints[static_cast<std::size_t>(joint)].channels;
  const auto has = [&](Channel c) { return std::find(channels.begin(), channels.end(), c) != channels.end(); };
  if (!positions_fit(clip, joint)) {
    auto place = std::find_if_not(channels.begin(), channels.end(), is_position) - channels.begin();
    for (const Channel c : {Channel::kXPosition, Channel::kYPosition, Channel::kZPosition})
      if (!has(c)) channels.insert(channels.begin() + place++, c);
  }
  const auto num_rotations = std::count_if(channels.begin(), channels.end(), [](Channel c) { return !is_position(c); });
  if (num_rotations < 3 && !rotations_fit(clip, joint, channels)) {
    const EulerOrder order = euler_order(clip.skeleton.joints[static_cast<std::size_t>(joint)]);
    for (auto n = num_rotations; n < 3; ++n)
      channels.push_back(static_cast<Channel>(static_cast<int>(Channel::kXRotation) + order.axis[n]));
  }
  return channels;
}

}  // namespace motex
