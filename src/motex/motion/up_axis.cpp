// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/up_axis.h"

namespace motex {
namespace {

/// (x, y, z) → (x, sign · z, −sign · y): −90° about x for sign = 1, +90° for −1.
Vector3 turned(const Vector3& v, double sign) { return {v.x(), sign * v.z(), -sign * v.y()}; }

Channel turned(Channel channel) {
  switch (channel) {
    case Channel::kYPosition:
      return Channel::kZPosition;
    case Channel::kZPosition:
      return Channel::kYPosition;
    case Channel::kYRotation:
      return Channel::kZRotation;
    case Channel::kZRotation:
      return Channel::kYRotation;
    default:
      return channel;
  }
}

void turn(Clip& clip, double sign) {
  clip.skeleton.skin = nullptr;  // it was bound to other frames
  for (EndSite& site : clip.skeleton.end_sites) site.offset = turned(site.offset, sign);
  for (int j = 0; j < clip.skeleton.num_joints(); ++j) {
    Joint& joint = clip.skeleton.joints[static_cast<std::size_t>(j)];
    joint.offset = turned(joint.offset, sign);
    for (Channel& channel : joint.channels) channel = turned(channel);
    for (Index t = 0; t < clip.num_frames(); ++t) {
      const Quat q = clip.rotation(t, j);
      const Vector3 axis = turned(q.vec(), sign);
      clip.set_translation(t, j, turned(clip.translation(t, j), sign));
      clip.set_rotation(t, j, Quat(q.w(), axis.x(), axis.y(), axis.z()));
    }
  }
}

void turn(MarkerSet& markers, double sign) {
  for (int m = 0; m < markers.num_markers(); ++m) {
    const Eigen::VectorXd y = markers.positions.col(3 * m + 1);
    markers.positions.col(3 * m + 1) = sign * markers.positions.col(3 * m + 2);
    markers.positions.col(3 * m + 2) = -sign * y;
  }
}

}  // namespace

void turn_z_up_to_y_up(Clip& clip) { turn(clip, 1); }
void turn_z_up_to_y_up(MarkerSet& markers) { turn(markers, 1); }
void turn_y_up_to_z_up(Clip& clip) { turn(clip, -1); }
void turn_y_up_to_z_up(MarkerSet& markers) { turn(markers, -1); }

}  // namespace motex
