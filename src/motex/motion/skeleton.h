// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "motex/motion/rotation.h"
#include "motex/motion/skin.h"

namespace motex {

/// What one number of a frame drives, in the order in which the file lists it.
enum class Channel : std::uint8_t { kXPosition, kYPosition, kZPosition, kXRotation, kYRotation, kZRotation };

/// "Xposition" … "Zrotation".
const char* channel_name(Channel channel);

struct Joint {
  std::string name;
  int parent_idx = -1;               ///< < own index; −1 for a root
  Vector3 offset = Vector3::Zero();  ///< position in the parent's frame when no channel says otherwise
  std::vector<Channel> channels;     ///< as in the file, kept so that writing restores them; may be empty
};

/// The tip of a limb: a point fixed to a joint.
struct EndSite {
  int parent_idx = 0;
  Vector3 offset = Vector3::Zero();
};

/// A tree of joints, parents before children. Y is up, right-handed, lengths in the file's unit.
struct Skeleton {
  std::vector<Joint> joints;
  std::vector<EndSite> end_sites;
  double metres_per_unit = 0;  ///< 0 = nobody knows
  /// What covers these joints, where the file had it; null without. Its joints are found by name.
  std::shared_ptr<const Skin> skin = nullptr;

  int num_joints() const { return static_cast<int>(joints.size()); }
  /// Index of the joint of that name, or −1.
  int find(const std::string& name) const;
};

/// Euler order of a joint's rotation channels; "zxy" completed with the missing axes when it has fewer than three.
EulerOrder euler_order(const Joint& joint);
bool has_position_channels(const Joint& joint);

/// Throws InvalidInput unless there is a joint, parents come before children and numbers are finite.
void check_skeleton(const Skeleton& skeleton);

/// "" when a and b have the same joint names and parents, else one sentence naming the first joint that differs.
std::string skeleton_difference(const Skeleton& a, const Skeleton& b);

/// Metres per unit: the skeleton's own, or chosen so that the body, standing, is 1.7 m: the longest path in offsets
/// from the lowest to the highest tip in the rest pose counts as the standing height.
double metres_per_unit_or_guess(const Skeleton& skeleton);

}  // namespace motex
