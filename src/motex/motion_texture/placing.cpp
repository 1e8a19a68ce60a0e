// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion_texture/placing.h"

#include <cmath>

#include "motex/core/error.h"

namespace motex {

Clip stand_at(const FeatureSpace& space, const Clip& clip, const RootPlace& place) {
  if (clip.num_frames() == 0) throw InvalidInput(clip.name + ": there is no frame to place");
  const RootPlace from = root_place(space, clip, 0);
  const double turn = place.heading - from.heading;
  const Quat rotation(std::cos(turn / 2), 0, std::sin(turn / 2), 0);
  const Vector3 pivot(from.x, 0, from.z), target(place.x, 0, place.z);
  const int root = space.travelling_joint;
  const int parent = clip.skeleton.joints[static_cast<std::size_t>(root)].parent_idx;
  Clip out = clip;
  Pose pose;
  for (Index t = 0; t < clip.num_frames(); ++t) {
    forward_kinematics(clip, t, pose);
    const Vector3 position = target + rotation * (Vector3(pose.positions.col(root)) - pivot);
    const Quat world = rotation * pose.rotation(root);
    const Quat above = parent < 0 ? Quat::Identity() : pose.rotation(parent);
    const Vector3 origin = parent < 0 ? Vector3::Zero() : Vector3(pose.positions.col(parent));
    out.set_translation(t, root, above.conjugate() * (position - origin));
    out.set_rotation(t, root, (above.conjugate() * world).normalized());
  }
  return out;
}

}  // namespace motex
