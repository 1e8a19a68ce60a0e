// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/motion/skeleton.h"

#include <algorithm>
#include <cmath>

#include "motex/core/error.h"

namespace motex {

const char* channel_name(Channel channel) {
  static constexpr const char* kNames[] = {"Xposition", "Yposition", "Zposition",
                                           "Xrotation", "Yrotation", "Zrotation"};
  return kNames[static_cast<int>(channel)];
}

int Skeleton::find(const std::string& name) const {
  for (int j = 0; j < num_joints(); ++j)
    if (joints[static_cast<std::size_t>(j)].name == name) return j;
  return -1;
}

EulerOrder euler_order(const Joint& joint) {
  EulerOrder order;
  int used = 0;
  const auto add = [&](int axis) {
    if (used < 3) order.axis[used++] = axis;
  };
  for (const Channel c : joint.channels)
    if (c >= Channel::kXRotation) add(static_cast<int>(c) - static_cast<int>(Channel::kXRotation));
  for (const int axis : {2, 0, 1})
    if (std::find(order.axis, order.axis + used, axis) == order.axis + used) add(axis);
  return order;
}

bool has_position_channels(const Joint& joint) {
  return std::any_of(joint.channels.begin(), joint.channels.end(), [](Channel c) { return c <= Channel::kZPosition; });
}

void check_skeleton(const Skeleton& skeleton) {
  if (skeleton.joints.empty()) throw InvalidInput("the skeleton has no joint");
  for (int j = 0; j < skeleton.num_joints(); ++j) {
    const Joint& joint = skeleton.joints[static_cast<std::size_t>(j)];
    if (joint.parent_idx < -1 || joint.parent_idx >= j)
      throw InvalidInput("joint '" + joint.name + "' stands before its parent");
    if (!joint.offset.allFinite()) throw InvalidInput("joint '" + joint.name + "' has an offset that is not finite");
  }
  for (const EndSite& site : skeleton.end_sites)
    if (site.parent_idx < 0 || site.parent_idx >= skeleton.num_joints() || !site.offset.allFinite())
      throw InvalidInput("an end site has no valid parent or offset");
}

std::string skeleton_difference(const Skeleton& a, const Skeleton& b) {
  const auto parent_name = [](const Skeleton& s, const Joint& joint) {
    return joint.parent_idx < 0 ? std::string("none")
                                : "'" + s.joints[static_cast<std::size_t>(joint.parent_idx)].name + "'";
  };
  for (std::size_t j = 0; j < std::min(a.joints.size(), b.joints.size()); ++j) {
    const Joint &x = a.joints[j], &y = b.joints[j];
    if (x.name != y.name)
      return "joint " + std::to_string(j) + " is '" + x.name + "' in one and '" + y.name + "' in the other";
    if (x.parent_idx != y.parent_idx)
      return "joint '" + x.name + "' hangs from " + parent_name(a, x) + " in one and from " + parent_name(b, y) +
             " in the other";
  }
  if (a.joints.size() == b.joints.size()) return "";
  const Skeleton& longer = a.joints.size() > b.joints.size() ? a : b;
  return "joint '" + longer.joints[std::min(a.joints.size(), b.joints.size())].name + "' exists in only one of them";
}

double metres_per_unit_or_guess(const Skeleton& skeleton) {
  if (skeleton.metres_per_unit > 0) return skeleton.metres_per_unit;
  // Standing height = way along the bones from the lowest tip to the highest; a hand may be farther and does not count.
  std::vector<double> reach(skeleton.joints.size(), 0);
  std::vector<double> rise(skeleton.joints.size(), 0);
  double lowest = 0, highest = 0, down = 0, up = 0, longest = 0;
  const auto consider = [&](double length, double height) {
    longest = std::max(longest, length);
    if (height < lowest) lowest = height, down = length;
    if (height > highest) highest = height, up = length;
  };
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    if (joint.parent_idx < 0) continue;
    const auto p = static_cast<std::size_t>(joint.parent_idx);
    reach[j] = reach[p] + joint.offset.norm();
    rise[j] = rise[p] + joint.offset.y();
    consider(reach[j], rise[j]);
  }
  for (const EndSite& site : skeleton.end_sites) {
    const auto p = static_cast<std::size_t>(site.parent_idx);
    consider(reach[p] + site.offset.norm(), rise[p] + site.offset.y());
  }
  // A rest pose that lies flat tells only the longest limb.
  const double height = highest - lowest > 0.2 * longest ? down + up : longest;
  return height > 0 ? 1.7 / height : 1.0;
}

}  // namespace motex
